#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

namespace burnish::inline solver {

/// Cholesky factors of sparse matrices on one pattern, P K Pᵀ = L Lᵀ, by the supernodes of CHOLMOD. K is given by
/// its upper triangle.
class Cholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Analyses the pattern: in CHOLMOD's order of the unknowns, or where that takes few operations, as in the plane,
  /// line by line across a patch if this takes fewer. Throws `std::bad_alloc`.
  explicit Cholesky(const Matrix& K);
  ~Cholesky();

  /// Not if the factors have more entries than CHOLMOD's indices can count.
  bool isAnalysed() const;

  /// False if K is not positive definite. Throws `std::bad_alloc`.
  [[nodiscard]] bool factorise(const Matrix& K);

  /// L⁻¹ P B. Throws `std::bad_alloc`.
  Eigen::MatrixXd forward(const Eigen::MatrixXd& B);

  /// Pᵀ L⁻ᵀ x. Throws `std::bad_alloc`.
  Eigen::VectorXd backward(const Eigen::VectorXd& x);

  /// Of L, and of multiplications and additions to make it.
  double nonZeros() const;
  double operations() const;

 private:
  struct Factors;

  std::unique_ptr<Factors> factors_;
};

}  // namespace burnish::inline solver
