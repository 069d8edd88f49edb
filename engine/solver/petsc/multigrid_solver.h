#pragma once
#include <memory>

#include "engine/solver/linear_solver.h"

namespace burnish::inline solver {

/// Krylov methods with multigrid for K. Levels are those of the problem's hierarchy, with coarse matrices PᵀKP
/// (Galerkin) and a Chebyshev polynomial of incomplete Cholesky factors as smoother, of three steps instead of one and
/// with factors of ranks that overlap where these pay, or one of symmetric successive over-relaxation where factors
/// are of no use: for the rest of a search for an equilibrium in which a system was met that they do not solve, and
/// for one, two, four, … searches behind it as they fail again.
/// The coarsest level is factorised. Within a search, factors and coarse matrices stay those of an earlier
/// matrix for as long as iterations come on nearly as fast. Without a border that is coupled with K a symmetric
/// matrix is left to conjugate gradients; else GMRES is preconditioned from the right with a multiplicative Schwarz
/// method: for a residual (r, g) of displacements and border
///
///     [ K_zz  B_z ] [ x ]   [ r_z ]
///     [ G_z   C   ] [ λ ] = [ g   ]        u = x + K̂⁻¹ ( r − K x − B λ ),
///
/// x over the zone where K is coupled with the border, see `BorderZone`, K without products, and K̂⁻¹ one V-cycle, for
/// the transpose of K where that is another matrix.
class MultigridSolver final : public LinearSolver {
 public:
  /// Throws `Error` if the problem has no hierarchy.
  explicit MultigridSolver(const LinearProblem& problem);
  ~MultigridSolver() override;

  void beginSearch() override;
  [[nodiscard]] bool factorise(SystemMatrix& A) override;
  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy& accuracy) override;

  /// Of the matrices of all levels: what a V-cycle goes through.
  Eigen::Index factorNonZeros() override;
  Definiteness definiteness() const override;
  long numIndefinite() const override;
  std::optional<IterationCounts> counts() const override;
  void archive(StateArchive& archive) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace burnish::inline solver
