#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

#include "engine/core/state_archive.h"

namespace burnish {

enum class TangentKind { Symmetric, General };

/// A sparse direct solver for matrices of one symmetric pattern. Symmetric ones have the form
///
///     A = [ K   B ]
///         [ Bᵀ  C ],
///
/// whose leading block K is usually positive definite and whose border, the multipliers, is coupled with
/// itself by nothing but the diagonal C. K is factorised by CHOLMOD and the border by a dense Cholesky
/// factorisation of its Schur complement; UMFPACK takes the whole matrix where one of them is not definite,
/// where the border is so wide that this is cheaper, and where the matrix is not symmetric.
class LinearSolver {
 public:
  /// `leading`: number of rows of K.
  explicit LinearSolver(Eigen::Index leading, TangentKind kind = TangentKind::Symmetric);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Returns false if the matrix is singular to working precision or not finite.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A);
  Eigen::VectorXd solve(const Eigen::VectorXd& b);

  /// Non-zeros of the last factors, 0 before the first: the cost of a solve that no other load on the machine
  /// changes.
  Eigen::Index factorNonZeros();

  /// Whether K and the Schur complement of the border were definite at the last factorisation.
  bool isDefinite() const { return isDefinite_; }

  /// Factorisations that UMFPACK did.
  long numGeneral() const;

  /// What is counted; what the solver does depends on the matrix alone.
  void archive(StateArchive& archive) { archive.field("general", numGeneral_); }

 private:
  class Definite;
  class General;

  std::unique_ptr<Definite> definite_;  ///< null for a general matrix
  std::unique_ptr<General> general_;
  bool hasFactors_ = false;
  bool isDefinite_ = false;  ///< the last matrix
  long numGeneral_ = 0;
};

}  // namespace burnish
