#include "engine/solver/multigrid.h"
#include "engine/solver/petsc/multigrid_solver.h"

/// What the program asks this library for. The caller owns the solver.
extern "C" burnish::LinearSolver* burnishMultigridSolver(const burnish::LinearProblem& problem) {
  return new burnish::MultigridSolver(problem);
}
