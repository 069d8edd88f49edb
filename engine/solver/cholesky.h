#pragma once
#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

namespace burnish {

/// Cholesky factors of sparse matrices on one pattern, P K Pᵀ = L Lᵀ, by the supernodes of CHOLMOD. K is given by
/// its upper triangle.
class Cholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Analyses the pattern: in CHOLMOD's order of the unknowns, or where that takes few operations, as in the plane,
  /// line by line across a patch if this takes fewer.
  explicit Cholesky(const Matrix& K);

  /// Not if memory has run out.
  bool isAnalysed() const { return factors_->info() == Eigen::Success; }

  /// False if K is not positive definite.
  [[nodiscard]] bool factorise(const Matrix& K);

  /// L⁻¹ P B. Throws `std::bad_alloc`.
  Eigen::MatrixXd forward(const Eigen::MatrixXd& B);

  /// Pᵀ L⁻ᵀ x. Throws `std::bad_alloc`.
  Eigen::VectorXd backward(const Eigen::VectorXd& x);

  /// Of L, and of multiplications and additions to make it.
  double nonZeros() const { return factors_->nonZeros; }
  double operations() const { return factors_->operations; }

 private:
  struct Factors : Eigen::CholmodSupernodalLLT<Matrix, Eigen::Upper> {
    double nonZeros = 0.0, operations = 0.0;

    /// order: of the unknowns; null: what CHOLMOD finds.
    void analyse(const Matrix& K, int* order);

    /// Solves with one of the factors.
    Eigen::MatrixXd apply(int which, Eigen::MatrixXd B);
  };

  std::unique_ptr<Factors> factors_;
};

}  // namespace burnish
