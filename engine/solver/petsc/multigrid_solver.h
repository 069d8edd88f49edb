#pragma once
#include <memory>

#include "engine/solver/linear_solver.h"

namespace burnish {

/// Krylov methods with multigrid for K. Levels are those of the problem's hierarchy, with coarse matrices PᵀKP
/// (Galerkin) and a Chebyshev polynomial of incomplete Cholesky factors as smoother, or one of symmetric
/// successive over-relaxation from the first system on for which these are of no use; the coarsest one is
/// factorised. Without a border that is coupled with K a symmetric matrix is left to conjugate gradients; else
/// GMRES is preconditioned from the right with
///
///     [ K̂  B ]
///     [ 0  Ŝ ],
///
/// K̂⁻¹ one V-cycle and Ŝ the Schur complement that K has where it is coupled with the border.
class MultigridSolver final : public LinearSolver {
 public:
  /// Throws `Error` if the problem has no hierarchy.
  explicit MultigridSolver(const LinearProblem& problem);
  ~MultigridSolver() override;

  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A) override;
  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) override;

  /// Of the matrices of all levels: what a V-cycle goes through.
  Eigen::Index factorNonZeros() override;
  Definiteness definiteness() const override;
  long numIndefinite() const override;
  std::optional<IterationCounts> counts() const override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace burnish
