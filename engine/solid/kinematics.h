#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <type_traits>
#include <vector>

#include "engine/material/response.h"

namespace burnish::inline solid {

/// How the gradients of a displacement field make a deformation gradient.
enum class Kinematics {
  Plane,         ///< plane strain: F_33 = 1
  Axisymmetric,  ///< x is the radius, y the axis: F_33 = 1 + u_x/R
  Solid
};

template <Kinematics K>
inline constexpr int kDimOf = K == Kinematics::Solid ? 3 : 2;

/// Columns of gradients per quadrature point: one per direction, and R_a/R in axisymmetry, the gradient of
/// F_33. Also the size of the block of F in which the volume can change.
template <Kinematics K>
inline constexpr int kColumns = K == Kinematics::Plane ? 2 : 3;

constexpr int gradientColumns(Kinematics kinematics) {
  return kinematics == Kinematics::Plane ? 2 : 3;
}

/// Calls f with the kinematics as a compile-time constant.
template <int Dim, class F>
auto withKinematics(Kinematics kinematics, const F& f) {
  if constexpr (Dim == 3)
    return f(std::integral_constant<Kinematics, Kinematics::Solid>{});
  else if (kinematics == Kinematics::Axisymmetric)
    return f(std::integral_constant<Kinematics, Kinematics::Axisymmetric>{});
  else
    return f(std::integral_constant<Kinematics, Kinematics::Plane>{});
}

/// Place of the tensor component (i, j) in `kVoigt` order.
constexpr int voigtPlace(int i, int j) {
  if (i == j) return i;
  return i + j == 1 ? 3 : (i + j == 3 ? 4 : 5);  // xy, yz, zx
}

/// Place of the tensor component that component i of the displacement makes through gradient column j; -1 if
/// it makes none. The third column of axisymmetry makes the 33 entry, from u_x alone.
template <Kinematics K>
constexpr int gradientPlace(int i, int j) {
  if (K == Kinematics::Axisymmetric && j == 2) return i == 0 ? 2 : -1;
  return voigtPlace(i, j);
}

/// Displacements of nodes, n x Dim, from the vector of unknowns.
template <int Dim>
void gatherNodes(const Eigen::VectorXd& x, const std::vector<int>& nodes,
                 Eigen::Matrix<double, Eigen::Dynamic, Dim>& u) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  u.resize(n, Dim);
  for (Eigen::Index a = 0; a < n; ++a) u.row(a) = x.segment<Dim>(Dim * nodes[static_cast<std::size_t>(a)]);
}

/// F = I + Σ u_a ⊗ ∇_X R_a; u: n x Dim, G: n x columns.
template <Kinematics K, class U, class G>
Eigen::Matrix3d deformationGradient(const Eigen::MatrixBase<U>& u, const Eigen::MatrixBase<G>& gradients) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (int i = 0; i < kDimOf<K>; ++i)
    for (int j = 0; j < kDimOf<K>; ++j) F(i, j) += u.col(i).dot(gradients.col(j));
  if constexpr (K == Kinematics::Axisymmetric) F(2, 2) += u.col(0).dot(gradients.col(2));
  return F;
}

/// det F. In axisymmetry it is not positive if the plane or the circumference is turned inside out, even if
/// both are.
template <Kinematics K>
double volumeRatio(const Eigen::Matrix3d& F) {
  const double inner = F.topLeftCorner<kDimOf<K>, kDimOf<K>>().determinant();
  if constexpr (K != Kinematics::Axisymmetric) return inner;
  const double smaller = std::min(inner, F(2, 2));
  return smaller > 0.0 ? inner * F(2, 2) : smaller;
}

/// What reference gradients (n x columns) are multiplied with to become gradients with respect to the current
/// positions.
template <Kinematics K>
Eigen::Matrix<double, kColumns<K>, kColumns<K>> pushForward(const Eigen::Matrix3d& F) {
  constexpr int D = kDimOf<K>;
  Eigen::Matrix<double, kColumns<K>, kColumns<K>> transform =
      Eigen::Matrix<double, kColumns<K>, kColumns<K>>::Zero();
  transform.template topLeftCorner<D, D>() = F.topLeftCorner<D, D>().inverse();
  if constexpr (K == Kinematics::Axisymmetric) transform(2, 2) = 1.0 / F(2, 2);
  return transform;
}

/// The identity of the block of F in which the volume can change, in `kVoigt` order.
template <Kinematics K>
Eigen::Vector<double, kVoigt<kDimOf<K>>> blockIdentity() {
  Eigen::Vector<double, kVoigt<kDimOf<K>>> one = Eigen::Vector<double, kVoigt<kDimOf<K>>>::Zero();
  one.template head<kColumns<K>>().setOnes();
  return one;
}

}  // namespace burnish::inline solid
