#include "engine/core/late_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish::inline core {

LateLibrary::LateLibrary(const char* file, const char* package)
    : file_(file), library_(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr)
    throw Error(fmt::format(
        "{} cannot be loaded: it is not installed (Debian package {}), or there is not enough memory", file,
        package));
}

void* LateLibrary::address(const char* name) const {
  void* found = dlsym(library_, name);
  if (found == nullptr) throw Error(fmt::format("{} has no {}", file_, name));
  return found;
}

}  // namespace burnish::inline core
