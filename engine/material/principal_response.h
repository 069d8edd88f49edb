#pragma once
#include "engine/material/principal_axes.h"

namespace burnish::inline material {

/// Stress and tangent of an isotropic response in its principal axes, with the (trial) stretches λ_A.
template <int Dim>
struct PrincipalResponse {
  Eigen::Vector3d tau;  ///< principal Kirchhoff stresses
  Eigen::Matrix3d D;    ///< ∂τ_A/∂ln λ_B
  /// ½ (τ_A − τ_B)(λ_A² + λ_B²)/(λ_A² − λ_B²) of every pair, the limit ¼(D_AA + D_BB − D_AB − D_BA) for equal
  /// stretches.
  Eigen::Matrix<double, PrincipalAxes<Dim>::kPairs, 1> secant;

  /// Sets stress and tangent: c_AABB = D_AB − 2 τ_A δ_AB, c_ABAB = secant − ½(τ_A + τ_B).
  void turn(const PrincipalAxes<Dim>& axes, MaterialResponse<Dim>& out) const {
    Eigen::Matrix3d normal = D;
    normal.diagonal() -= 2.0 * tau;
    auto shear = secant;
    for (int pair = 0; pair < PrincipalAxes<Dim>::kPairs; ++pair)
      shear[pair] -= 0.5 * (tau[PrincipalAxes<Dim>::first(pair)] + tau[PrincipalAxes<Dim>::second(pair)]);
    out.tau = axes.tensor(tau);
    out.c = axes.tangent(normal, shear);
  }
};

}  // namespace burnish::inline material
