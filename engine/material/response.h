#pragma once
#include <Eigen/Core>

namespace burnish {

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
  double plasticWork = 0.0;   ///< H(e_p) − H(e_p,n) of this step, with H = ∫ σ_y de_p
};

/// History of a quadrature point: where plastic flow last left it. The pair (F_inv, b_e) stands for
/// Cp^{-1} = F^{-1} b_e F^{-T}: a trial state needs only the deformation f = F F_inv since then, b_tr = f b_e
/// f^T, whose rounding error grows with the condition of F and not with its square.
struct MaterialState {
  Eigen::Matrix3d F_inv =
      Eigen::Matrix3d::Identity();  ///< inverse deformation gradient at the last plastic flow
  Eigen::Matrix3d b_e = Eigen::Matrix3d::Identity();  ///< elastic left Cauchy-Green tensor there
  double e_p = 0.0;                                   ///< equivalent plastic strain

  /// Inverse plastic right Cauchy-Green tensor.
  Eigen::Matrix3d Cp_inv() const { return F_inv * b_e * F_inv.transpose(); }
};

}  // namespace burnish
