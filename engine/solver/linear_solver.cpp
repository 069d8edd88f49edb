#include "engine/solver/linear_solver.h"

#include <fmt/format.h>

#include <array>

#include "engine/core/error.h"
#include "engine/solver/direct_solver.h"

namespace burnish {
namespace {

template <class Solver>
std::unique_ptr<LinearSolver> make(Eigen::Index leading, TangentKind kind) {
  return std::make_unique<Solver>(leading, kind);
}

/// A linear solver and its name in scenes.
struct NamedSolver {
  const char* name;
  std::unique_ptr<LinearSolver> (*make)(Eigen::Index leading, TangentKind kind);
};

/// All linear solvers, one line each.
constexpr std::array kSolvers{
    NamedSolver{"direct", make<DirectSolver>},
};

}  // namespace

std::vector<std::string> linearSolverNames() {
  std::vector<std::string> names;
  for (const NamedSolver& solver : kSolvers) names.emplace_back(solver.name);
  return names;
}

std::unique_ptr<LinearSolver> makeLinearSolver(const LinearSolverOptions& options, Eigen::Index leading,
                                               TangentKind kind) {
  for (const NamedSolver& solver : kSolvers)
    if (options.name == solver.name) return solver.make(leading, kind);
  throw Error(fmt::format("there is no linear solver {}", options.name));
}

}  // namespace burnish
