#pragma once
#include <memory>

#include "engine/solver/linear_solver.h"

namespace burnish::inline solver {

/// Sparse factorisations. K is factorised by CHOLMOD and the border by a dense Cholesky factorisation of its
/// Schur complement; UMFPACK takes the whole matrix where one of them is not definite, and where the border is
/// so wide that this is cheaper. General matrices, tangents with friction, are solved by GMRES with a symmetric
/// matrix near to them, which is factorised in the same way, as preconditioner; UMFPACK takes those for which
/// that does not lead to a solution.
class DirectSolver final : public LinearSolver {
 public:
  /// `leading`: number of rows of K.
  explicit DirectSolver(Eigen::Index leading, TangentKind kind = TangentKind::Symmetric);
  ~DirectSolver() override;

  [[nodiscard]] bool factorise(SystemMatrix& A) override { return factorise(A.whole()); }
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A);
  Eigen::VectorXd solve(const Eigen::VectorXd& b);
  Eigen::VectorXd solve(const Eigen::VectorXd& b, const SolveAccuracy&) override { return solve(b); }
  Eigen::Index factorNonZeros() override;
  Definiteness definiteness() const override {
    // Of a general matrix K's symmetric part is factorised, which then leaves no direction unstable.
    return isDefinite_ || hasCompanion_ ? Definiteness::Definite : Definiteness::NotDefinite;
  }

  /// Factorisations that UMFPACK did.
  long numIndefinite() const override { return numGeneral_; }

  void archive(StateArchive& archive) override { archive.field("general", numGeneral_); }

 private:
  class Definite;
  class Companion;
  class General;

  bool factoriseWhole(const Eigen::SparseMatrix<double>& A);

  std::unique_ptr<Definite> definite_;    ///< null for general matrices
  std::unique_ptr<Companion> companion_;  ///< null for symmetric ones
  std::unique_ptr<General> general_;
  bool hasFactors_ = false;
  bool isDefinite_ = false;    ///< the last matrix
  bool hasCompanion_ = false;  ///< the last matrix
  long numGeneral_ = 0;
};

}  // namespace burnish::inline solver
