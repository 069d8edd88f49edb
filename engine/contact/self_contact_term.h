#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/contact/averaged_gaps.h"
#include "engine/contact/contact_options.h"
#include "engine/contact/surface_curve.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solver/term.h"

namespace burnish {

/// Quantities of self-contact at the last evaluated state; gaps are infinite without partners.
struct SelfContactState : FaceContactState {
  Eigen::Matrix2Xd partner, normal;  ///< closest points and their normals; zero without

  /// Resultant of the part that comes first on the other one; in axisymmetry of whole rings, along the axis.
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
};

/// Frictionless contact of one face of a plane or axisymmetric body with itself: mortar, augmented
/// Lagrangian. Of two points that face each other the one with the smaller parameter is the slave: it carries
/// the quadrature and the multipliers; the other one is its closest point x̄ on the same curve, with the
/// outward normal n there. Gap g = (x - x̄) · n >= 0; g_A, λ̂_A and the active set as in contact with a tool
/// (31)-(43), with averages over the points that have a partner, of gaps as `limitedGap` has them.
///
/// Who is whose partner is decided at accepted states and kept during a step, in which only the closest
/// points move: the residual is smooth but for the active set. With δw the difference of the two points'
/// variations at fixed parameters, t = dx̄, δt its variation, m = t · t, k = n · ddx̄ and h = m - g k, the
/// parameter of the closest point moves by (t · δw + g n · δt)/h, and
///
///     δg = n · δw,   δ²g = -(2 (t·δw)(n·δt) + k/m (t·δw)² + g (n·δt)²)/h,
///
/// at a kink, where it does not move, δ²g = (t·δw)²/g with the unit vector t across n. A gap that is limited
/// to φ(g) has the traction λ̂ φ' and adds φ'' (δg)² to φ' δ²g.
class SelfContactTerm final : public Term {
 public:
  using Options = SelfContactOptions;

  /// options: with a parameter and a reach. firstMultiplier: number of the first of the face's multipliers
  /// among the unknowns. mayPenetrate: a little, in the reference configuration: that of a new mesh. Throws
  /// `Error` as `requireAveragedGaps`.
  SelfContactTerm(const Body<2>& body, int patch, FaceId face, Options options, int firstMultiplier,
                  bool mayPenetrate = false);

  int firstMultiplier() const { return firstMultiplier_; }
  int numMultipliers() const { return face_.numFunctions(); }

  /// See `ContactTerm::setParameter`.
  void setParameter(double parameter) { options_.parameter = parameter; }
  double parameter() const { return *options_.parameter; }
  double reach() const { return *options_.reach; }

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void accept() override { findPartners(false); }
  void archive(StateArchive& archive) override { archive.fixedField("partners", partners_); }

  const SelfContactState& state() const { return state_; }
  const FaceQuadrature<2>& face() const { return face_; }
  const Options& options() const { return options_; }

  /// A_A = ∫ R_A dΓ (32).
  const Eigen::VectorXd& weights() const { return A_; }

  /// Positions of the quadrature points in the last evaluated state, 2 x points. Slaves that touch their
  /// partners, or are nearer to them or inside of them by less than a share of their span, are moved out to
  /// that distance.
  Eigen::Matrix2Xd positionsApart(double share) const;

 private:
  struct Mortar;
  struct Slave;

  SurfaceCurve curveAt(const Eigen::VectorXd& x) const;
  std::optional<SurfaceCurve::Point> partnerOf(const Slave& slave, double start,
                                               double largestPenetration) const;
  std::optional<double> searchPartner(const std::vector<Slave>& slaves, std::size_t number,
                                      bool mayPenetrate) const;
  void findPartners(bool mayPenetrate);
  bool integrate(Mortar& mortar) const;
  void addForces(const Eigen::VectorXd& x, Assembly& out, const Mortar& mortar);
  void addGeometricTangent(Assembly& out, const Mortar& mortar) const;

  FaceQuadrature<2> face_;
  Patch<1, 2> trace_;
  double outward_;
  bool axisymmetric_;
  double rounding_;  ///< of lengths
  Options options_;
  int firstMultiplier_;
  Eigen::VectorXd A_;
  std::vector<int> unknowns_;     ///< displacement components of the face's nodes
  std::vector<double> partners_;  ///< parameter per quadrature point, kNone without
  SurfaceCurve curve_;            ///< in the last evaluated state
  SelfContactState state_;
};

}  // namespace burnish
