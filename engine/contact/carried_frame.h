#pragma once
#include <Eigen/Dense>
#include <array>

namespace burnish::inline contact {

/// Unit vectors e_α across a normal n, one in the plane, two in space, with their derivatives by n.
template <int Dim>
struct CarriedFrame {
  Eigen::Matrix<double, Dim, Dim - 1> vectors;                    ///< e_α
  std::array<Eigen::Matrix<double, Dim, Dim>, Dim - 1> byNormal;  ///< de_α = byNormal[α] dn
};

/// In the plane e = (n_y, -n_x), whatever the origin. In space the vectors E_α across n_0 are carried to n by
/// the smallest rotation,
///
///     e_α  = E_α - (n·E_α)/(1 + n_0·n) (n_0 + n)
///     de_α = -[(dn·E_α)(n_0 + n) + (n·E_α) dn]/(1 + n_0·n) + (n·E_α)(n_0·dn)(n_0 + n)/(1 + n_0·n)²
///
/// n and n_0 must not be opposite to each other.
template <int Dim>
CarriedFrame<Dim> carriedFrame(const Eigen::Matrix<double, Dim, Dim - 1>& origin,
                               const Eigen::Vector<double, Dim>& originNormal,
                               const Eigen::Vector<double, Dim>& normal);

/// Some unit vectors across a normal.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> anyFrame(const Eigen::Vector<double, Dim>& normal);

}  // namespace burnish::inline contact
