#include "engine/core/module_function.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace burnish::inline core {
namespace {

/// How one comes by a module that is not there.
std::string remedy(const Module& module) {
  if (module.option == nullptr) return "it belongs to the program: install both";
  return fmt::format("install it (Debian: apt-get install {}), or build it with {}, that is without {}=OFF",
                     module.package, module.builtFor, module.option);
}

/// Whether the loader says of this very file that it has not found it; of a library that the file needs it says the same.
bool isAbsent(const Module& module, std::string_view reason) {
  return reason.starts_with(fmt::format("{}: cannot open shared object file: No such file", module.library));
}

}  // namespace

void* moduleFunction(const Module& module, const char* name, const char* whatFor) {
  void* library =
      dlopen(module.library, (module.bindsLate ? RTLD_LAZY : RTLD_NOW) | RTLD_LOCAL | RTLD_NODELETE);
  void* function = library != nullptr ? dlsym(library, name) : nullptr;
  if (function != nullptr) return function;
  const std::string reason = dlerror();
  if (isAbsent(module, reason))
    throw ModuleError(whatFor, fmt::format("{}, which is not there", module.library), remedy(module));
  throw ModuleError(whatFor,
                    fmt::format("{}, which is there but cannot be loaded: {}", module.library, reason),
                    "install what it misses, or the one that belongs to this program");
}

}  // namespace burnish::inline core
