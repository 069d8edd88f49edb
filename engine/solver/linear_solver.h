#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/state_archive.h"
#include "engine/core/team.h"
#include "engine/solver/hierarchy.h"
#include "engine/solver/solver_options.h"
#include "engine/solver/system_matrix.h"

namespace burnish::inline solver {

enum class TangentKind { Symmetric, General };

/// What is known of all systems that a solver shall solve.
struct LinearProblem {
  Eigen::Index leading = 0;  ///< number of rows of K
  TangentKind kind = TangentKind::Symmetric;
  const Hierarchy* hierarchy =
      nullptr;                  ///< of the first unknowns; must outlive the solver. Null: none is known
  const Team* team = &alone();  ///< that solves the systems together; must outlive the solver
  Division rows{};              ///< of several ranks: of K, whose rows are in the order of the division
};

/// How well a system is to be solved by a method that comes nearer and nearer.
struct SolveAccuracy {
  Eigen::VectorXd rowWeights;  ///< by which residuals are measured; one per row
  double reduction = 1e-12;    ///< of the norm of the weighted residual over that of the right-hand side

  /// Weighted norm of the right-hand side over that of the system before, in the same search; small where Newton's method
  /// converges, and the matrix is almost the same.
  double fallen = 1.0;
};

/// Whether K and the Schur complement of the border are definite for a matrix.
enum class Definiteness { Definite, NotDefinite, NotKnown };

/// What iterative methods have done so far.
struct IterationCounts {
  long iterations = 0;
  long systems = 0;
  long setUps = 0;     ///< of preconditioners
  long fallbacks = 0;  ///< systems that were solved by another method in the end
};

/// Solves linear systems with matrices of one symmetric pattern. Symmetric ones have the form
///
///     A = [ K   B ]
///         [ Bᵀ  C ],
///
/// whose leading block K is usually positive definite and whose border, the multipliers, has a C that is
/// negative semidefinite: a diagonal, or sparse. Where several ranks solve them together, right-hand sides and
/// solutions are whole on each, and every member is to be called by all of them.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Tells that the search for another equilibrium begins: until the next one does, matrices may be near each
  /// other.
  virtual void beginSearch() {}

  /// Returns false if the matrix is singular to working precision or not finite. A must stay as it is until
  /// the last system with it is solved.
  [[nodiscard]] virtual bool factorise(SystemMatrix& A) = 0;

  /// Solves with the last matrix that was factorised: as well as rounding allows, or by an iterative method to
  /// the accuracy that is asked for. Not finite if that cannot be reached.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) = 0;

  /// Non-zeros of the last factors, 0 before the first: the cost of a solve that no other load on the machine
  /// changes.
  virtual Eigen::Index factorNonZeros() = 0;

  /// Of the last matrix. If it is not known, unstable directions are not looked for.
  virtual Definiteness definiteness() const { return Definiteness::NotDefinite; }

  /// Factorisations of matrices that were not known to be definite.
  virtual long numIndefinite() const { return 0; }

  /// None for a direct solver.
  virtual std::optional<IterationCounts> counts() const { return std::nullopt; }
  bool isIterative() const { return counts().has_value(); }

  /// What is counted, and what later searches depend on beside their matrices.
  virtual void archive(StateArchive&) {}
};

/// The solver that the options name; "auto" is multigrid if there is a hierarchy. Throws `Error` for an unknown
/// name, and for a solver that this program was built without.
std::unique_ptr<LinearSolver> makeLinearSolver(const LinearSolverOptions& options,
                                               const LinearProblem& problem);

}  // namespace burnish::inline solver
