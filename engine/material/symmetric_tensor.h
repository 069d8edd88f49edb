#pragma once
#include <Eigen/Core>

#include "engine/material/response.h"

/// Symmetric tensors as vectors in the component order of `kVoigt`.
namespace burnish::inline material {

template <int Dim>
using SymmetricTensor = Eigen::Matrix<double, kVoigt<Dim>, 1>;

/// Components of the symmetric tensor T; for Dim 2 those that couple the plane with the third direction are
/// dropped.
template <int Dim>
SymmetricTensor<Dim> components(const Eigen::Matrix3d& T) {
  if constexpr (Dim == 2)
    return {T(0, 0), T(1, 1), T(2, 2), T(0, 1)};
  else
    return {T(0, 0), T(1, 1), T(2, 2), T(0, 1), T(1, 2), T(2, 0)};
}

/// The symmetric tensor with these components.
template <int Dim>
Eigen::Matrix3d fullTensor(const SymmetricTensor<Dim>& T) {
  const double yz = Dim == 3 ? T[kVoigt<Dim> - 2] : 0.0;
  const double zx = Dim == 3 ? T[kVoigt<Dim> - 1] : 0.0;
  return Eigen::Matrix3d{{T[0], T[3], zx}, {T[3], T[1], yz}, {zx, yz, T[2]}};
}

/// The second-order identity.
template <int Dim>
SymmetricTensor<Dim> identityComponents() {
  SymmetricTensor<Dim> one = SymmetricTensor<Dim>::Zero();
  one.template head<3>().setOnes();
  return one;
}

/// The matrix of a (1 ⊗ 1) + b 𝕀 with 𝕀 the fourth-order symmetric identity.
template <int Dim>
typename MaterialResponse<Dim>::Tangent isotropicTangent(double a, double b) {
  typename MaterialResponse<Dim>::Tangent c = MaterialResponse<Dim>::Tangent::Zero();
  c.template topLeftCorner<3, 3>().setConstant(a);
  c.diagonal().template head<3>().array() += b;
  c.diagonal().template tail<kVoigt<Dim> - 3>().array() += 0.5 * b;
  return c;
}

/// T : T.
template <int Dim>
double squaredNorm(const SymmetricTensor<Dim>& T) {
  return T.template head<3>().squaredNorm() + 2.0 * T.template tail<kVoigt<Dim> - 3>().squaredNorm();
}

}  // namespace burnish::inline material
