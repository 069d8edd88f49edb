#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/contact/drag.h"
#include "engine/contact/partner_term.h"

namespace burnish::inline contact {

/// Mortar contact of one face ("slave") with a partner, with Coulomb friction: augmented Lagrangian with
/// multipliers λ_A and, with friction, τ_A of the slave's control points; or a penalty, in which λ_A = 0, τ_A is
/// the traction τᵉ_A of the accepted state, and rows and columns of multipliers are left out. Integrals over the
/// reference face, over points that have a partner (∫'), N = ∂g and T, S of `ContactPoint`:
///
///     A_A = ∫' R_A dΓ,   g_A = 1/A_A ∫' R_A g dΓ,   s_A = 1/A_A ∫' R_A s dΓ,
///     D_A = A_A ∂g_A = ∫' R_A N dΓ,   T_A = ∫' R_A T dΓ,   S_A = A_A ∂s_A = ∫' R_A S dΓ,
///     λ̂_A = λ_A + ε g_A, active where λ̂_A <= 0,   τ̂_A = τ_A + ε_T s_A,   τᵉ_A of `coulombTraction` (with the
///     law at the function's mean place, with the mean stretch of area in the accepted state),
///     R_u += Σ λ̂_A D_A + T_A τᵉ_A,   R_λA = A_A g_A or -A_A/ε λ_A,   R_τA = A_A/ε_T (τᵉ_A - τ_A).
///
/// With M = ∂τᵉ/∂τ̂, c = ∂τᵉ/∂λ̂ of active functions, λ̂ = Σ R_A λ̂_A and t = Σ R_A τᵉ_A at a point
///
///     K_uu += Σ ε/A_A D_A D_Aᵀ + ε_T/A_A T_A M S_Aᵀ + ε/A_A T_A c D_Aᵀ + ∫' λ̂ ∂²g + ∂(t·δs_T) dΓ,
///     K_uλ = D_A + T_A c,   K_uτ = T_A M,   K_λu = D_Aᵀ,   K_τu = M S_Aᵀ + ε/ε_T c D_Aᵀ,
///     K_τλ = A_A/ε_T c,   K_ττ = A_A/ε_T (M - I),
///
/// symmetric without friction. With a gap limit averages take φ(g) of `limitedGap`. Tractions at a point are φ'
/// times λ̂ and t, and slips count as much, so that places which are open neither rub nor slip: with
/// B_A = ∫' R_A φ' dΓ in the place of A_A under slips
///
///     g_A = 1/A_A ∫' R_A φ dΓ,   D_A = ∫' R_A φ' N dΓ,   T_A = ∫' R_A φ' T dΓ,
///     s_A = 1/B_A ∫' R_A φ' s dΓ,   S_A = B_A ∂s_A = ∫' R_A (φ' S + φ'' (s - s_A) N) dΓ,
///
/// and in the tangent ∫' λ̂ (φ' ∂²g + φ'' N Nᵀ) + φ' ∂(t·δs_T) + φ'' (t·T) Nᵀ dΓ. A function with less than
/// a twentieth of its weight over points with a partner is not active, and its multipliers vanish; neither is
/// one over open places alone (`kOpenSlope`).
///
/// Where the partner has segments, integrals are sums over those that have a partner, each with a rule of its
/// own; what is told of quadrature points are values there.
template <int Dim>
class MortarContactTerm final : public PartnerTerm<Dim> {
 public:
  /// options: with a parameter. firstMultiplier: number of the first of the pair's multipliers among the
  /// unknowns. definitions: of names in the formula for friction. The body must outlive the term. Throws
  /// `Error` as `requireAveragedGaps` and `FrictionLaw`.
  MortarContactTerm(const Body<Dim>& body, int patch, FaceId face, const PartnerMaker<Dim>& makePartner,
                    const ContactOptions& options, int firstMultiplier,
                    const std::vector<DefinitionSpec>& definitions = {});

  /// Those λ_A come first; then, with friction, the components of τ_A one after the other. A penalty has none.
  int numMultipliers() const override {
    return isPenalty(options_.method) ? 0 : (hasFriction_ ? Dim : 1) * face_.numFunctions();
  }

  CouplingGroups couplings() const override;

 private:
  using typename PartnerTerm<Dim>::Tangential;
  using typename PartnerTerm<Dim>::Components;
  using typename PartnerTerm<Dim>::Span;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Dim - 1>;

  /// A span of the face or a segment of it, with its rule; points are numbered over all parts.
  struct Part {
    std::size_t span = 0;
    Span rule;
  };

  struct Average;
  struct Sums;
  struct Traction;

  bool assemble(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions, Assembly& out) override;
  void takeSegments() override {
    if (hasSegments_) chooseParts();
  }
  Components lastTractions() const override;

  void chooseParts();

  /// Numbers of λ_A and, with friction, the components of τ_A.
  std::vector<int> multiplierUnknowns(int A) const;

  SlavePoint<Dim> pointAt(const Part& part, Eigen::Index q, const Eigen::MatrixXd& positions) const;
  std::optional<ContactPoint<Dim>> contactAt(const SlavePoint<Dim>& slave) const;
  LimitedGap limitedAt(std::size_t e, const ContactPoint<Dim>& point) const;
  Eigen::MatrixXd partPositions(const Eigen::VectorXd& x) const;
  std::optional<Sums> measure(const Eigen::MatrixXd& positions) const;
  void integrate(Sums& sums) const;
  void chooseActive(const Eigen::VectorXd& x, const Sums& sums);
  FrictionTraction<Dim - 1> frictionOf(int A, const Average& average, double t,
                                       const Eigen::VectorXd& x) const;
  void addFunctions(double t, const Eigen::VectorXd& x, Assembly& out, const Sums& sums);
  void chooseTractions(double t, const Eigen::VectorXd& x, const Sums& sums);
  void addFriction(int A, const Average& average, const Eigen::VectorXd& x, Assembly& out,
                   Eigen::MatrixXd& K);
  Traction tractionAt(const std::vector<int>& functions, const Eigen::Ref<const Eigen::VectorXd>& R,
                      const LimitedGap& limited) const;
  void addPoints(Assembly& out, const Eigen::MatrixXd& positions, const Sums& sums);
  void reportAt(const SlavePoint<Dim>& slave, const ContactPoint<Dim>& point, const Traction& traction);
  void reportPoints(const Eigen::MatrixXd& positions);

  using FaceContact<Dim>::face_;
  using FaceContact<Dim>::options_;
  using FaceContact<Dim>::firstMultiplier_;
  using FaceContact<Dim>::axisymmetric_;
  using FaceContact<Dim>::A_;
  using FaceContact<Dim>::state_;
  using FaceContact<Dim>::gapOrigin_;
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

  const Body<Dim>& body_;
  std::vector<Part> parts_;  ///< of all spans, or segments that have a partner
  bool hasSegments_ = false;
  int numPoints_ = 0;                                 ///< of all parts
  Drag<Dim> drag_;                                    ///< in the last evaluation
  std::vector<FrictionTraction<Dim - 1>> tractions_;  ///< τᵉ_A of the last evaluation; empty without friction
};

}  // namespace burnish::inline contact
