#pragma once
#include <memory>

#include "engine/solver/linear_solver.h"

namespace burnish::inline solver {

/// Whether the program was built with multigrid.
bool hasMultigrid();

/// The multigrid solver of PETSc, with a direct one for what it does not solve. Its library, which needs longer
/// to start than most runs need for a step, is loaded by the first call. Throws `Error` if the program was
/// built without it, if it cannot be loaded, or if the problem has no hierarchy.
std::unique_ptr<LinearSolver> makeMultigridSolver(const LinearProblem& problem);

}  // namespace burnish::inline solver
