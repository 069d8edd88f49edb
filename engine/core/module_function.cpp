#include "engine/core/module_function.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish {

void* moduleFunction(const Module& module, const char* name, const char* whatFor) {
  void* library = dlopen(module.library, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* function = library != nullptr ? dlsym(library, name) : nullptr;
  if (function == nullptr)
    throw Error(fmt::format(
        "{} needs {}, which is not there ({}); {}", whatFor, module.library, dlerror(),
        module.option != nullptr
            ? fmt::format("it is built with {}, that is without {}=OFF", module.builtFor, module.option)
            : "it belongs to the program: install both"));
  return function;
}

}  // namespace burnish
