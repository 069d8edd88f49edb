#include "engine/solver/linear_solver.h"

#include <fmt/format.h>

#include <array>

#include "engine/core/error.h"
#include "engine/solver/direct_solver.h"
#include "engine/solver/multigrid.h"

namespace burnish::inline solver {
namespace {

std::unique_ptr<LinearSolver> makeDirectSolver(const LinearProblem& problem) {
  return std::make_unique<DirectSolver>(problem.leading, problem.kind);
}

std::unique_ptr<LinearSolver> makeEitherSolver(const LinearProblem& problem) {
  return problem.hierarchy != nullptr ? makeMultigridSolver(problem) : makeDirectSolver(problem);
}

/// A linear solver and its name in scenes.
struct NamedSolver {
  const char* name;
  std::unique_ptr<LinearSolver> (*make)(const LinearProblem& problem);
};

/// All linear solvers, one line each.
constexpr std::array kSolvers{
    NamedSolver{"direct", makeDirectSolver},
    NamedSolver{"multigrid", makeMultigridSolver},
    NamedSolver{"auto", makeEitherSolver},
};

}  // namespace

std::vector<std::string> linearSolverNames() {
  std::vector<std::string> names;
  for (const NamedSolver& solver : kSolvers) names.emplace_back(solver.name);
  return names;
}

std::unique_ptr<LinearSolver> makeLinearSolver(const LinearSolverOptions& options,
                                               const LinearProblem& problem) {
  for (const NamedSolver& solver : kSolvers)
    if (options.name == solver.name) return solver.make(problem);
  throw Error(fmt::format("there is no linear solver {}", options.name));
}

}  // namespace burnish::inline solver
