#pragma once
#include <Eigen/Core>

namespace burnish::inline material {

/// Number of components of a symmetric tensor, in the order xx yy zz xy (2D: plane strain, axisymmetry) or
/// xx yy zz xy yz zx (3D). Components are those of the tensor, without factors of two.
template <int Dim>
inline constexpr int kVoigt = Dim == 2 ? 4 : 6;

/// What a law answers at one quadrature point, per reference volume.
template <int Dim>
struct MaterialResponse {
  using Stress = Eigen::Matrix<double, kVoigt<Dim>, 1>;
  using Tangent = Eigen::Matrix<double, kVoigt<Dim>, kVoigt<Dim>>;

  Stress tau;  ///< Kirchhoff stress
  Tangent c;   ///< spatial tangent c_ijkl of K = ∫ ∇^s δu : c : ∇^s Δu + (∇δu τ) : ∇Δu
  double strainEnergy = 0.0;  ///< stored, without hardening
  double plasticWork = 0.0;   ///< of this step: what a law dissipates, or stores in its hardening
};

}  // namespace burnish::inline material
