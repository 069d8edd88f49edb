#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <memory>

namespace burnish::inline solver {

/// Counts the directions in which an equilibrium is unstable. For tangents as `LinearSolver` describes them,
///
///     A = [ K   B ]
///         [ Bᵀ  C ],
///
/// these are the negative eigenvalues of K on displacements d with Bᵀd = 0, B the columns of the active
/// multipliers. They are counted as the negative pivots of L D Lᵀ = K + B W Bᵀ (Sylvester's law of inertia),
/// W a diagonal that is large beside K. Where C is more than a diagonal, multipliers stand for their
/// constraint only in part: then the negative pivots of A with C - W⁻¹ are counted, less one per multiplier.
/// Of a matrix that is not symmetric its symmetric part is taken.
class Inertia {
 public:
  /// `leading`: number of rows of K.
  explicit Inertia(Eigen::Index leading);
  ~Inertia();
  Inertia(const Inertia&) = delete;
  Inertia& operator=(const Inertia&) = delete;

  /// All matrices must have the pattern of the first one, which is symmetric.
  int unstableDirections(const Eigen::SparseMatrix<double>& A);

 private:
  class Factors;

  Eigen::Index n_;
  std::unique_ptr<Factors> factors_;  ///< null before the first matrix
};

}  // namespace burnish::inline solver
