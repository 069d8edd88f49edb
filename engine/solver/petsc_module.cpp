#include "engine/solver/petsc_module.h"

#include "engine/core/module_function.h"

namespace burnish::inline solver {

void* petscFunction(const char* name, const char* whatFor) {
  return moduleFunction({"burnish_petsc.so", "PETSc", "BURNISH_PETSC", "burnish-multigrid"}, name, whatFor);
}

}  // namespace burnish::inline solver
