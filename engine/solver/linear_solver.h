#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

namespace burnish {

/// A sparse direct solver for matrices of one pattern.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// Returns false if the matrix is singular to working precision or not finite.
  [[nodiscard]] virtual bool factorise(const Eigen::SparseMatrix<double>& A) = 0;
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;

  /// Non-zeros of the factors: the cost of a solve that no other load on the machine changes.
  virtual Eigen::Index factorNonZeros() = 0;
};

/// What is known of the matrix before it is assembled.
enum class MatrixKind {
  SaddlePoint,     ///< indefinite: UMFPACK
  LikelyDefinite,  ///< symmetric, usually positive definite: CHOLMOD, with UMFPACK taking over when it is not
};

std::unique_ptr<LinearSolver> makeLinearSolver(MatrixKind kind);

}  // namespace burnish
