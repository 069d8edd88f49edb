#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/contact/partner_term.h"

namespace burnish::inline contact {

/// Point-wise penalty contact of one face ("slave") with a partner, with Coulomb friction. At every quadrature
/// point with a partner, with N = ∂g and T, S of `ContactPoint`, τ_n the traction of the accepted state there
///
///     λ̂ = ε g where g < 0, else 0,   τ̂ = τ_n + ε_T s,   τᵉ of `coulombTraction` where g < 0, else 0,
///     R_u += ∫ λ̂ N + T τᵉ dΓ,
///     K_uu += ∫_{g<0} ε N Nᵀ + λ̂ ∂²g + ε_T T M Sᵀ + ε T c Nᵀ + ∂(τᵉ·δs_T) dΓ
///
/// over the reference face, M = ∂τᵉ/∂τ̂ and c = ∂τᵉ/∂λ̂. The contact energy is ∫ ½ ε g² dΓ. Points remember
/// tractions and do not move: segments of the partner are none of its.
template <int Dim>
class PointwisePenaltyTerm final : public PartnerTerm<Dim> {
 public:
  /// options: with a parameter. definitions: of names in the formula for friction. Throws `Error` as
  /// `FrictionLaw`.
  PointwisePenaltyTerm(const Body<Dim>& body, int patch, FaceId face, const PartnerMaker<Dim>& makePartner,
                       const ContactOptions& options, int firstMultiplier,
                       const std::vector<DefinitionSpec>& definitions = {})
      : PartnerTerm<Dim>(body, patch, face, makePartner, options, firstMultiplier, definitions,
                         PartnerTerm<Dim>::TractionsOf::Points) {}

  int numMultipliers() const override { return 0; }
  CouplingGroups couplings() const override;
  double smallestReferenceGap(const GapAt& gapAt) const override { return this->smallestGapOfPoints(gapAt); }

 private:
  using typename PartnerTerm<Dim>::Tangential;
  using typename PartnerTerm<Dim>::Components;

  struct Touch;

  bool assemble(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions, Assembly& out) override;
  Components lastTractions() const override { return tractions_; }

  void measure(const Eigen::MatrixXd& positions);
  Eigen::Index pointInTouch() const;
  double pressedGap(const ContactPoint<Dim>& contact) const { return contact.gap - touching_; }
  FrictionTraction<Dim - 1> frictionOf(const Touch& touch, double t) const;
  void addSpan(std::size_t e, const std::vector<Touch>& touches, double t, Assembly& out);

  using FaceContact<Dim>::face_;
  using FaceContact<Dim>::state_;
  using FaceContact<Dim>::keepsInTouch_;
  using FaceContact<Dim>::parameter;
  using FaceContact<Dim>::frictionParameter;
  using FaceContact<Dim>::frictionLaw_;
  using FaceContact<Dim>::slipped_;
  using FaceContact<Dim>::work_;
  using PartnerTerm<Dim>::partner_;
  using PartnerTerm<Dim>::hasFriction_;
  using PartnerTerm<Dim>::touching_;
  using PartnerTerm<Dim>::remembered_;
  using PartnerTerm<Dim>::pointAt;

  Components tractions_;  ///< τᵉ of the last evaluation, quadrature points; with friction
};

}  // namespace burnish::inline contact
