#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

#include "engine/core/state_archive.h"
#include "engine/solver/solver_options.h"

namespace burnish {

enum class TangentKind { Symmetric, General };

/// Solves linear systems with matrices of one symmetric pattern, until it is told to forget that. Symmetric ones have the form
///
///     A = [ K   B ]
///         [ Bᵀ  C ],
///
/// whose leading block K is usually positive definite and whose border, the multipliers, has a C that is
/// negative semidefinite: a diagonal, or sparse.
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Returns false if the matrix is singular to working precision or not finite.
  [[nodiscard]] virtual bool factorise(const Eigen::SparseMatrix<double>& A) = 0;

  /// The next matrix may have another pattern. What is known of the last matrix stays known, but that it can be
  /// solved with.
  virtual void forgetPattern() = 0;

  /// Solves with the last matrix that was factorised.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;

  /// Non-zeros of the last factors, 0 before the first: the cost of a solve that no other load on the machine
  /// changes.
  virtual Eigen::Index factorNonZeros() = 0;

  /// Whether K and the Schur complement of the border are known to be definite for the last matrix: then no
  /// unstable directions are looked for.
  virtual bool isDefinite() const { return false; }

  /// Factorisations of matrices for which that was not known.
  virtual long numIndefinite() const { return 0; }

  /// What is counted; what the solver does depends on the matrix alone.
  virtual void archive(StateArchive&) {}
};

/// The solver that the options name. `leading`: number of rows of K. Throws `Error` for an unknown name.
std::unique_ptr<LinearSolver> makeLinearSolver(const LinearSolverOptions& options, Eigen::Index leading,
                                               TangentKind kind = TangentKind::Symmetric);

}  // namespace burnish
