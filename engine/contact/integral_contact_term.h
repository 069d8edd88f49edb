#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "engine/contact/coulomb.h"
#include "engine/contact/drag.h"
#include "engine/contact/face_contact.h"
#include "engine/contact/multiplier_basis.h"
#include "engine/contact/partner.h"
#include "engine/contact/relative_length.h"

namespace burnish::inline contact {

/// Contact of one face ("slave") with a partner, complementarity at the quadrature points
/// ("integral" augmented Lagrangian; Poulios and Renard, Comput. Struct. 153 (2015)). The multiplier
/// λ = Σ M_A λ_A is a field of the face's own trace, N = ∂g the derivative of the gap by the unknowns,
///
///     p = min(0, λ + r g),   χ = 1 where λ + r g < 0, else 0,   L_c = ∫ (p² - λ²)/(2r) dΓ,
///     R_u += ∫ p N dΓ,   R_λA = -1/r ∫ (λ - p) M_A dΓ,
///     K_uu += ∫ χ r N Nᵀ + p ∂²g dΓ,   K_uλ = ∫ χ N M_A dΓ,   K_λλ = -1/r ∫ (1 - χ) M_A M_B dΓ,
///
/// over the reference face, with p = 0 at points without a partner. p is the contact pressure; λ agrees with
/// it where the face is pressed and ripples around zero elsewhere. r should be Young's modulus over the
/// distance of control points: in a span where the contact ends it weighs gaps against tractions. So r and r_T
/// are the parameters where spans have their mean length, and go with the reciprocal `RelativeLength`.
///
/// In the plane a span is split where λ + r g changes its sign, and where partnership ends: p has a kink
/// there; and where the curvature of a tool jumps, as between the tip and a flank of a wedge: so has p its second derivative.
/// The split moves with the unknowns, but the integrands agree on both sides of it, so that the tangent
/// takes no part in that: between splits they are smooth, and where their rules end does not count. At a crease, where the
/// normals of a tool jump, it lacks a little. In space such a span has twice the points in each direction; so have, with friction, all spans that are pressed:
/// tractions have kinks between stick and slip, too, and points that moved with a split would be no rule for
/// these. Where the partner has segments, spans that are pressed are split at their ends as well.
///
/// Friction: τ = Σ M_A τ_A along the frame e_α, slip s and virtual slip δs_T = T of the partner, S = ∂s,
///
///     τ̂ = τ + r_T s,   b = μ ⟨-p⟩, no more than the shear limit,
///     τᵉ = τ̂ where |τ̂| <= b (stick), b τ̂/|τ̂| elsewhere (slip), 0 where p = 0,
///     R_u += ∫ T τᵉ dΓ,   R_τA = 1/r_T ∫ (τᵉ - τ) M_A dΓ,
///
/// with the derivatives M = ∂τᵉ/∂τ̂ and c = ∂τᵉ/∂(λ + r g) in the tangent, which is not symmetric. τᵉ points
/// along the slip of the face and is the traction on the partner.
template <int Dim>
class IntegralContactTerm final : public FaceContact<Dim> {
 public:
  /// options: with a parameter. firstMultiplier: number of the first of the pair's multipliers among the
  /// unknowns. held: displacement components that supports prescribe. definitions: of names in the formula for
  /// friction. The body must outlive the term. Throws `Error` as `FrictionLaw`.
  IntegralContactTerm(const Body<Dim>& body, int patch, FaceId face, const PartnerMaker<Dim>& makePartner,
                      const ContactOptions& options, int firstMultiplier, const std::vector<bool>& held,
                      const std::vector<DefinitionSpec>& definitions = {});

  /// Those λ_A come first; then, with friction, the components of τ_A one after the other.
  int numMultipliers() const override {
    return multipliers_.size() + (hasFriction_ ? (Dim - 1) * tangential_.size() : 0);
  }

  int multiplierOf(int function, int component) const override;

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  bool hasSymmetricTangent() const override { return !hasFriction_; }
  void accept() override;
  void archive(StateArchive& archive) override;

  Eigen::VectorXd referenceGaps(const GapAt& gapAt) const override;
  double smallestReferenceGap(const GapAt& gapAt) const override;

 private:
  using Span = typename FaceQuadrature<Dim>::Span;
  using Parameter = Eigen::Vector<double, Dim - 1>;
  using Tangential = Eigen::Vector<double, Dim - 1>;

  /// Points of a span at which the sign of λ + r g is looked at: equally spaced in the plane, ends included;
  /// in space those of the finer rule.
  struct Samples {
    Eigen::MatrixXd xi;  ///< (Dim-1) x S
    Eigen::MatrixXd R;   ///< n x S
  };

  /// The anchor of a function.
  struct Anchor {
    std::size_t span = 0;
    Parameter xi;
    RationalShape<Dim - 1> shape;  ///< of the span's functions
  };

  struct SpanValues;
  struct Contributions;
  enum class SpanState { Open, Closed, Cut };

  void addSpanTables();
  void splitSpans();
  std::vector<Span> rulesBetween(std::size_t e, const std::vector<double>& ends, int points) const;
  std::vector<double> signChanges(const SpanValues& values) const;
  std::vector<double> partEnds(const SpanValues& values) const;
  SpanValues valuesOf(std::size_t e, const Eigen::VectorXd& x) const;
  static SlavePoint<Dim> pointOf(const SpanValues& values, const Parameter& xi,
                                 const Eigen::Ref<const Eigen::VectorXd>& R, int number = -1);

  double lengthAt(const SlavePoint<Dim>& point) const {
    return relativeLength_.at(face_.spans()[point.span].number, point.xi);
  }

  /// λ + r g at a point; infinite without a partner.
  double augmented(const SpanValues& values, const SlavePoint<Dim>& point, double gap) const;
  double augmented(const SpanValues& values, const SlavePoint<Dim>& point) const;

  /// Friction at a point with slip, p < 0 the contact pressure; dR: derivatives of the functions.
  FrictionTraction<Dim - 1> frictionAt(const SpanValues& values, const SlavePoint<Dim>& point,
                                       const ContactPoint<Dim>& contact, double p,
                                       const Eigen::Ref<const Eigen::MatrixXd>& dR) const;

  void reportFriction(const SpanValues& values, const Span& span, Eigen::Index q,
                      const SlavePoint<Dim>& point, double p);
  void reportPoints(const SpanValues& values);
  void reportAnchors(const std::vector<SpanValues>& values);
  SpanState stateOf(const SpanValues& values) const;

  /// The quadrature of a span in the state that it is in.
  std::vector<Span> rulesOf(const SpanValues& values, SpanState state) const;

  void addOpenSpan(const SpanValues& values, Contributions& sums);
  void addPoint(const SpanValues& values, const Span& rule, Eigen::Index q, bool mustTouch,
                Contributions& sums);
  void endFriction();
  void addOpenTangential(const SpanValues& values, const SlavePoint<Dim>& point, double w,
                         Contributions& sums) const;
  void addFriction(const SpanValues& values, const Span& rule, Eigen::Index q, double p,
                   const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact,
                   const std::vector<Eigen::Index>& places, Contributions& sums);
  void addForce(const Eigen::Vector<double, Dim>& force, const SlavePoint<Dim>& point, Eigen::Vector3d& sum,
                Eigen::Vector3d& moment) const;

  /// Numbers of the unknowns behind the multipliers of a span's functions, λ first; -1 for none.
  std::vector<int> multiplierUnknowns(std::size_t e) const;
  void addToSystem(const Contributions& sums, Assembly& out) const;

  using FaceContact<Dim>::face_;
  using FaceContact<Dim>::options_;
  using FaceContact<Dim>::firstMultiplier_;
  using FaceContact<Dim>::axisymmetric_;
  using FaceContact<Dim>::A_;
  using FaceContact<Dim>::gapOrigin_;
  using FaceContact<Dim>::keepsInTouch_;
  using FaceContact<Dim>::state_;
  using FaceContact<Dim>::isAlone;
  using FaceContact<Dim>::parameter;
  using FaceContact<Dim>::frictionParameter;
  using FaceContact<Dim>::frictionLaw_;
  using FaceContact<Dim>::slipped_;
  using FaceContact<Dim>::work_;
  using FaceContact<Dim>::referencePlace;
  using FaceContact<Dim>::areaStretch;

  const Body<Dim>& body_;
  std::unique_ptr<Partner<Dim>> partner_;
  bool hasFriction_;
  Drag<Dim> drag_;  ///< in the last evaluated state
  MultiplierBasis multipliers_, tangential_;
  std::vector<Samples> samples_;           ///< per span
  std::vector<std::vector<double>> cuts_;  ///< per span: ends of segments inside of it
  std::vector<std::vector<Span>> rules_;   ///< per span: its own, or one per segment
  std::vector<std::vector<Span>> fine_;    ///< the same with twice the points, in space and with friction
  RelativeLength<Dim - 1> relativeLength_;
  std::vector<Eigen::MatrixXd> mass_;       ///< per span: ∫ R_a R_b ℓ dΓ, ℓ the relative length
  std::vector<std::vector<int>> unknowns_;  ///< per span: displacement components
  std::vector<Anchor> anchors_;             ///< per function
  double time_ = 0.0;                       ///< of the evaluation
};

}  // namespace burnish::inline contact
