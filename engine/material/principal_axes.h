#pragma once
#include <Eigen/Core>

#include "engine/material/symmetric_tensor.h"

namespace burnish::inline material {

/// Spectral decomposition of a symmetric tensor, Σ values_A n_A ⊗ n_A, also accurate for nearly equal values.
/// For Dim 2 the third direction is the one out of the plane.
template <int Dim>
struct PrincipalAxes {
  static constexpr int kPairs = kVoigt<Dim> - 3;

  explicit PrincipalAxes(const Eigen::Matrix3d& T);

  /// Two directions A != B of the pair with this number, in the order 12, 23, 31.
  static constexpr int first(int pair) { return pair; }
  static constexpr int second(int pair) { return (pair + 1) % 3; }

  /// Σ t_A n_A ⊗ n_A.
  SymmetricTensor<Dim> tensor(const Eigen::Vector3d& t) const { return basis.template leftCols<3>() * t; }

  /// The fourth-order tensor with normal[A][B] = c_AABB and shear[pair] = c_ABAB = c_ABBA.
  typename MaterialResponse<Dim>::Tangent tangent(const Eigen::Matrix3d& normal,
                                                  const Eigen::Matrix<double, kPairs, 1>& shear) const;

  Eigen::Vector3d values;
  /// Columns: n_A ⊗ n_A for the three directions, then n_A ⊗ n_B + n_B ⊗ n_A for the pairs.
  Eigen::Matrix<double, kVoigt<Dim>, kVoigt<Dim>> basis;
};

}  // namespace burnish::inline material
