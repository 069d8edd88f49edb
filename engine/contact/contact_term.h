#pragma once
#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "engine/contact/tool_contact.h"
#include "engine/contact/tool_passage.h"

namespace burnish::inline contact {

/// Frictionless contact of one face of the body with a rigid tool: mortar methods and point-wise penalty.
template <int Dim>
class ContactTerm final : public FaceContact<Dim> {
 public:
  using Options = ContactOptions;

  /// `firstMultiplier`: number of the first of the face's multipliers among the unknowns (augmented
  /// Lagrangian only). Throws `Error` if a weight A_A (32) is not positive (Lagrange bases above degree 7, or
  /// of higher degree than 1 where an axisymmetric face meets the axis). options: with a parameter. The tool
  /// must outlive the term.
  ContactTerm(const Body<Dim>& body, int patch, FaceId face, const Tool& tool, const Options& options,
              int firstMultiplier);

  int numMultipliers() const override;

  CouplingGroups couplings() const override;
  bool evaluate(double t, const Eigen::VectorXd& x, Assembly& out) override;
  void accept() override;
  void archive(StateArchive& archive) override { passage_.archive(archive); }

  /// `referenceGaps` to the tool with their derivatives by the control points of the face, functions x
  /// Dim·functions, as far as these move its points: what the face's area changes by is left out.
  struct LinearGaps {
    Eigen::VectorXd values;
    Eigen::MatrixXd gradient;
    Eigen::VectorXd slopes;  ///< averaged ones of limited gaps, see `kOpenSlope`
  };
  LinearGaps linearReferenceGaps(const ToolPose& pose) const;

  double smallestReferenceGap(const GapAt& gapAt) const override;

 private:
  struct Mortar;

  Mortar integrate(const ToolPose& pose, const Eigen::VectorXd& x) const;
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

  const Tool& tool_;
  std::vector<std::size_t> dofs_;           ///< free ones of the tool
  std::vector<std::vector<int>> supports_;  ///< per function: functions that share a span with it, sorted
  std::vector<std::vector<std::vector<int>>>
      slots_;  ///< [span][a][b]: place of function b in the support of function a
  ToolPassage passage_;
};

}  // namespace burnish::inline contact
