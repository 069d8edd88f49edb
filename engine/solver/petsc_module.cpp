#include "engine/solver/petsc_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr const char* kLibrary = "burnish_petsc.so";

}  // namespace

void* petscFunction(const char* name, const char* whatFor) {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* function = library != nullptr ? dlsym(library, name) : nullptr;
  if (function == nullptr)
    throw Error(fmt::format(
        "{} needs {}, which is not there ({}); it is built with PETSc, that is without BURNISH_PETSC=OFF",
        whatFor, kLibrary, dlerror()));
  return function;
}

}  // namespace burnish
