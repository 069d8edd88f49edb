#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

namespace burnish {

/// Cholesky factors of sparse matrices on one pattern, P K Pᵀ = L Lᵀ. K is given by its upper triangle.
class Cholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  Cholesky() = default;
  virtual ~Cholesky() = default;
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// False if K is not positive definite.
  [[nodiscard]] virtual bool factorise(const Matrix& K) = 0;

  /// L⁻¹ P B.
  virtual Eigen::MatrixXd forward(const Eigen::MatrixXd& B) = 0;

  /// Pᵀ L⁻ᵀ x.
  virtual Eigen::VectorXd backward(const Eigen::VectorXd& x) = 0;

  /// Of L, and of multiplications and additions to make it.
  virtual double nonZeros() const = 0;
  virtual double operations() const = 0;
};

/// What is expected to be faster for the pattern of K: LAPACK's band matrices where the band is narrow, as it
/// is for the rows of a spline patch that is a few tens of functions wide, else CHOLMOD. Null if CHOLMOD has
/// run out of memory.
std::unique_ptr<Cholesky> makeCholesky(const Cholesky::Matrix& K);

}  // namespace burnish
