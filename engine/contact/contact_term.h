#pragma once
#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "engine/contact/averaged_gaps.h"
#include "engine/contact/contact_options.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solver/term.h"
#include "engine/tools/tool.h"

namespace burnish {

/// Contact quantities at the last evaluated state.
struct ContactState : FaceContactState {
  Eigen::MatrixXd normal;  ///< of the tool, away from it, 3 x quadrature points
  Eigen::Vector3d reaction =
      Eigen::Vector3d::Zero();  ///< force of the body on the tool; whole rings in axisymmetry
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of that force about the tool's pivot
  double energy = 0.0;

  /// Force with which a tool that is free to move would have to be held back to stay in touch; > 0 where
  /// its load pulls it off the body.
  double pull = 0.0;
};

/// Frictionless contact of one face of the body with a rigid tool.
template <int Dim>
class ContactTerm final : public Term {
 public:
  using Options = ContactOptions;

  /// `firstMultiplier`: number of the first of the face's multipliers among the unknowns (augmented
  /// Lagrangian only). Throws `Error` if a weight A_A (32) is not positive (Lagrange bases above degree 7, or
  /// of higher degree than 1 where an axisymmetric face meets the axis). options: with a parameter. The tool
  /// must outlive the term.
  ContactTerm(const Body<Dim>& body, int patch, FaceId face, const Tool& tool, const Options& options,
              int firstMultiplier);

  /// Multipliers that this pair adds to the unknowns, and the first of them.
  int numMultipliers() const;
  int firstMultiplier() const { return firstMultiplier_; }

  /// Makes this pair the one that keeps a tool with free degrees of freedom in touch with the body, without
  /// which its place is not determined: while nothing is active, here or in the tool's other pairs (which are
  /// evaluated before), the nearest function (or point) counts as active.
  void keepInTouch(std::vector<const ContactTerm*> others);

  /// Averaged gaps are measured from these values instead of zero (mortar methods): those with which a state
  /// that does not fit begins can be taken away little by little. One per function; empty: from zero.
  void measureGapsFrom(Eigen::VectorXd origin) { gapOrigin_ = std::move(origin); }

  /// Replaces ε. With an augmented Lagrangian the way into equilibrium depends on it, the equilibrium does
  /// not.
  void setParameter(double parameter) { options_.parameter = parameter; }
  double parameter() const { return *options_.parameter; }

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void accept() override;
  void archive(StateArchive& archive) override { archive.field("points_in_tool", pointsInTool_); }

  const ContactState& state() const { return state_; }
  const FaceQuadrature<Dim>& face() const { return face_; }
  const Options& options() const { return options_; }

  /// A_A = ∫ R_A dΓ (32).
  const Eigen::VectorXd& weights() const { return A_; }

  /// Averaged gaps g_A between the undeformed face and the tool at a place.
  Eigen::VectorXd referenceGaps(const ToolPose& pose) const;

  /// The same with their derivatives by the control points of the face, functions x Dim·functions, as far as
  /// these move its points: what the face's area changes by is left out.
  struct LinearGaps {
    Eigen::VectorXd values;
    Eigen::MatrixXd gradient;
    Eigen::VectorXd slopes;  ///< averaged ones of limited gaps, see `kOpenSlope`
  };
  LinearGaps linearReferenceGaps(const ToolPose& pose) const;

  /// Smallest gap between the undeformed face and the tool at a place, of those that the method closes:
  /// averaged ones, or those of the quadrature points.
  double smallestReferenceGap(const ToolPose& pose) const;

 private:
  struct Mortar;

  Mortar integrate(const ToolPose& pose, const Eigen::VectorXd& x) const;
  Mortar integrateReference(const ToolPose& pose) const;
  bool isTooDeep(const Mortar& mortar) const;

  /// Positions of the quadrature points in the tool's reference position, one after the other.
  Eigen::VectorXd pointsInTool(const ToolPose& pose, const Eigen::MatrixXd& positions) const;

  /// Whether a point has gone through a thin part of the tool on its way from the accepted state, which the
  /// gap at the way's end does not tell.
  bool hasPassedThrough() const;
  bool isAlone() const;
  void chooseActive(const Eigen::VectorXd& x, const Mortar& mortar);
  void evaluateMortar(const Eigen::VectorXd& x, Assembly& out, const Mortar& mortar);
  void evaluatePointwise(Assembly& out, const Mortar& mortar);
  void addGeometricTangent(Assembly& out, const Mortar& mortar);
  void measureReaction(const ToolPose& pose, const Mortar& mortar);

  /// Derivative of the gap at a point of a span by the unknowns of the span's functions.
  Eigen::VectorXd gapDerivative(const typename FaceQuadrature<Dim>::Span& span, Eigen::Index q,
                                const ToolGap& query) const;

  /// Displacement components of functions, then the tool's free degrees of freedom.
  std::vector<int> unknownsOf(const std::vector<int>& functions) const;

  FaceQuadrature<Dim> face_;
  const Tool& tool_;
  std::vector<std::size_t> dofs_;  ///< free ones of the tool
  Options options_;
  int firstMultiplier_;
  bool axisymmetric_;
  double deepest_;  ///< inside the tool that a point may be
  Eigen::VectorXd A_;
  Eigen::VectorXd gapOrigin_;
  std::vector<std::vector<int>> supports_;  ///< per function: functions that share a span with it, sorted
  std::vector<std::vector<std::vector<int>>>
      slots_;  ///< [span][a][b]: place of function b in the support of function a
  bool keepsInTouch_ = false;
  std::vector<const ContactTerm*> others_;
  ContactState state_;
  Eigen::VectorXd pointsInTool_;       ///< in the accepted state; empty before the first
  Eigen::VectorXd trialPointsInTool_;  ///< in the last evaluated one; both empty for a tool of any depth
};

}  // namespace burnish
