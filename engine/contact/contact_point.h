#pragma once
#include <Eigen/Dense>
#include <vector>

namespace burnish::inline contact {

/// Gap and slip at one quadrature point of a contact face ("slave"), as functions of the unknowns around it:
/// the displacement components of the slave's functions there, function by function, then the partner's
/// unknowns (displacement components of a master face's functions there, or a tool's free degrees of
/// freedom).
template <int Dim>
struct ContactPoint {
  std::vector<int> unknowns;
  double gap = 0.0;                   ///< g, positive outside
  Eigen::Vector<double, Dim> normal;  ///< n, outward normal of the partner
  int part = 0;                       ///< of the partner, see `GapQuery`
  Eigen::VectorXd dGap;               ///< N = ∂g, unknowns
  Eigen::MatrixXd d2Gap;              ///< ∂²g, unknowns x unknowns; empty unless it was asked for

  // With friction; frames e_α of unit vectors across n, one in the plane, two in space.
  Eigen::Matrix<double, Dim, Dim - 1> frame;
  Eigen::Vector<double, Dim - 1> slip;                         ///< e_α · s since the last accepted state
  Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> virtualSlip;  ///< T: e_α · δs_T, unknowns
  Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> dSlip;        ///< S: ∂(e_α · s), unknowns
};

}  // namespace burnish::inline contact
