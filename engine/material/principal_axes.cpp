#include "engine/material/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace burnish::inline material {

/// One Jacobi rotation, which makes the block diagonal without cancellation.
template <>
PrincipalAxes<2>::PrincipalAxes(const Eigen::Matrix3d& T) {
  double tangent = 0.0;
  if (T(0, 1) != 0.0) {
    const double theta = (T(1, 1) - T(0, 0)) / (2.0 * T(0, 1));
    tangent = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(1.0 + theta * theta));
  }
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const double sine = tangent * cosine;
  values = {T(0, 0) - tangent * T(0, 1), T(1, 1) + tangent * T(0, 1), T(2, 2)};
  const double cc = cosine * cosine;
  const double ss = sine * sine;
  const double cs = cosine * sine;
  // n_1 = (c, −s), n_2 = (s, c)
  basis << cc, ss, 0.0, 2.0 * cs,  //
      ss, cc, 0.0, -2.0 * cs,      //
      0.0, 0.0, 1.0, 0.0,          //
      -cs, cs, 0.0, cc - ss;
}

template <>
PrincipalAxes<3>::PrincipalAxes(const Eigen::Matrix3d& T) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(T);  // iterative: the direct formula loses half the digits near equal values
  values = solver.eigenvalues();
  const Eigen::Matrix3d& n = solver.eigenvectors();
  for (int A = 0; A < 3; ++A) basis.col(A) = components<3>(n.col(A) * n.col(A).transpose());
  for (int pair = 0; pair < kPairs; ++pair) {
    const Eigen::Matrix3d product = n.col(first(pair)) * n.col(second(pair)).transpose();
    basis.col(3 + pair) = components<3>(product + product.transpose());
  }
}

template <int Dim>
typename MaterialResponse<Dim>::Tangent PrincipalAxes<Dim>::tangent(
    const Eigen::Matrix3d& normal, const Eigen::Matrix<double, kPairs, 1>& shear) const {
  const auto axes = basis.template leftCols<3>();
  const auto pairs = basis.template rightCols<kPairs>();
  const Eigen::Matrix<double, kVoigt<Dim>, 3> weighted = axes * normal;
  const Eigen::Matrix<double, kVoigt<Dim>, kPairs> weightedPairs = pairs * shear.asDiagonal();
  typename MaterialResponse<Dim>::Tangent c;
  c.noalias() = weighted * axes.transpose();
  c.noalias() += weightedPairs * pairs.transpose();
  return c;
}

template struct PrincipalAxes<2>;
template struct PrincipalAxes<3>;

}  // namespace burnish::inline material
