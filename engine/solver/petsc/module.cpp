#include "engine/solver/petsc/mpi_team.h"
#include "engine/solver/petsc/multigrid_solver.h"

/// What the program asks this library for. The caller owns the solver.
extern "C" burnish::LinearSolver* burnishMultigridSolver(const burnish::LinearProblem& problem) {
  return new burnish::MultigridSolver(problem);
}

/// All processes that were started together, until the process ends.
extern "C" const burnish::Team* burnishTeam() {
  static const burnish::MpiTeam team;
  return &team;
}
