#include "engine/core/module_function.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish {

void* moduleFunction(const Module& module, const char* name, const char* whatFor) {
  void* library = dlopen(module.library, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* function = library != nullptr ? dlsym(library, name) : nullptr;
  if (function == nullptr)
    throw Error(
        fmt::format("{} needs {}, which is not there ({}); it is built with {}, that is without {}=OFF",
                    whatFor, module.library, dlerror(), module.builtFor, module.option));
  return function;
}

}  // namespace burnish
