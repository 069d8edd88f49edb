#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/contact/carried_frame.h"
#include "engine/contact/master_surface.h"

namespace burnish::inline contact {

/// Variations at a slave point x = Σ R_a x_a and its foot y = Σ R_b y_b as rows over the n displacement
/// components of the slave's functions, then of the foot's nodes, then of others if there are some.
///
/// δw = Σ R_a δx_a - Σ R_b δy_b is the difference of both at fixed parameters. Over the parameters α, β … of
/// the foot that move, with m_αβ = y_α·y_β, κ_αβ = n·y_αβ, h = m - g κ, y^α = m^{αβ} y_β, a_α = y_α·δw and
/// b_α = n·δy_α:
///
///     δg  = n·δw,   δη = h⁻¹ (a + g b)
///     Δδg = -[aᵀ h⁻¹ Δb + bᵀ h⁻¹ Δa + aᵀ m⁻¹ κ h⁻¹ Δa + g bᵀ h⁻¹ Δb] + (1/g) δw·Q Δw
///     δn  = -y^α (b_α + κ_αβ δη^β) + (1/g) Q δw
///
/// Q = I - n⊗n - y_α⊗y^α is left of the directions across n on lines and at corners, where the foot does not
/// follow the position; it is zero elsewhere. 1/g is left out for gaps below rounding.
template <int Dim>
class PairRows {
 public:
  using Vector = Eigen::Vector<double, Dim>;
  using Rows = Eigen::Matrix<double, Dim, Eigen::Dynamic>;
  using FrameRows = Eigen::Matrix<double, Eigen::Dynamic, Dim - 1>;

  /// R: of the slave's functions. others: nodes beside those of the foot, which must outlive the object.
  PairRows(const Eigen::Ref<const Eigen::VectorXd>& R, const Foot<Dim>& foot, int others = 0);

  Eigen::VectorXd dGap() const { return difference_.transpose() * foot_.normal; }
  Eigen::MatrixXd d2Gap() const;

  /// δn, Dim x n.
  const Rows& dNormal() const { return dNormal_; }

  /// Variation of a vector between two places that keep their parameters: of x and of one more place of the
  /// master. nodes: where its functions stand among the nodes of foot and others.
  Rows differenceTo(const Eigen::Ref<const Eigen::VectorXd>& R, const std::vector<int>& nodes) const;

  /// ∂(e_α·s) of the slip s = (I - n⊗n) v, n x (Dim-1). way: v; difference: δv.
  FrameRows dSlip(const CarriedFrame<Dim>& frame, const Vector& way, const Rows& difference) const;

  /// e_α·δs_T of the virtual slip δs_T = (I - n⊗n) δw + g y^β b_β, n x (Dim-1): what friction does work on.
  /// Its second part balances moments; on lines and at corners g n x t_⟂ of a traction t is left over, with
  /// the part t_⟂ along directions in which the foot does not move.
  FrameRows virtualSlip(const CarriedFrame<Dim>& frame) const;

  /// Δ(t·δs_T), rows of the variation, columns of the increment, of a traction t across n that changes with n
  /// alone. With c^β = t·y^β and Δ̂y_γ = Δy_γ + y_γδ Δη^δ:
  ///
  ///     δw·Δt - (t·δy_β) Δη^β + c^β b_β Δg + g [b_β Δc^β + c^β δy_β·Δn + c^β (n·δy_βγ) Δη^γ]
  ///     Δc^β = y^β·Δt - c^γ y^β·Δ̂y_γ + m^{βγ} (t - c^δ y_δ)·Δ̂y_γ
  ///
  /// byNormal: Δt = byNormal Δn.
  Eigen::MatrixXd frictionTangent(const Vector& traction,
                                  const Eigen::Matrix<double, Dim, Dim>& byNormal) const;

 private:
  static constexpr int P = Dim - 1;
  using Parameters = Eigen::Matrix<double, P, P>;

  Rows shiftedBy(const Eigen::Ref<const Eigen::VectorXd>& values) const;

  const Foot<Dim>& foot_;
  Eigen::Index slaves_;  ///< functions of the slave
  Eigen::Index size_;
  Eigen::VectorXd R_;
  Rows difference_;                         ///< δw
  Eigen::Matrix<double, Dim, P> dual_;      ///< y^α of parameters that move, else zero
  Parameters mInverse_, hInverse_, kappa_;  ///< of parameters that move, else zero
  Eigen::Matrix<double, P, Eigen::Dynamic> a_, b_, dEta_;
  Eigen::Matrix<double, Dim, Dim> edge_;  ///< Q/g
  Rows dNormal_;
};

}  // namespace burnish::inline contact
