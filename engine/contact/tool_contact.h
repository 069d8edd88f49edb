#pragma once
#include <Eigen/Dense>
#include <memory>
#include <utility>
#include <vector>

#include "engine/contact/averaged_gaps.h"
#include "engine/contact/contact_options.h"
#include "engine/solid/face_quadrature.h"
#include "engine/solver/term.h"
#include "engine/tools/tool.h"

namespace burnish {

/// Contact quantities at the last evaluated state. Methods that close averaged gaps have g_A and λ̂_A per
/// function, the integral one gap and contact pressure -p where the function's anchor is.
struct ContactState : FaceContactState {
  Eigen::MatrixXd normal;  ///< of the tool, away from it, 3 x quadrature points
  Eigen::Vector3d reaction =
      Eigen::Vector3d::Zero();  ///< force of the body on the tool; whole rings in axisymmetry
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of that force about the tool's pivot
  double energy = 0.0;
  double area = 0.0;  ///< reference area under pressure; the integral method alone knows it

  /// Force with which a tool that is free to move would have to be held back to stay in touch; > 0 where
  /// its load pulls it off the body.
  double pull = 0.0;

  // With friction.
  Eigen::Matrix3Xd traction;  ///< of friction on the tool, nominal, quadrature points; empty without friction
  Eigen::Matrix3Xd slip;      ///< way of the face on the tool in this step; of points that are not open
  std::vector<int> sliding;   ///< quadrature points: 0 open, 1 stick, 2 slip; empty without friction
  int sticking = 0, slipping = 0;  ///< functions
  double frictionForce = 0.0;      ///< ∫ |t| dΓ
  double frictionWork = 0.0;       ///< taken by friction since the start
};

/// Contact of one face of the body with a rigid tool, as the rest of the program sees it whatever the method.
template <int Dim>
class ToolContact : public Term {
 public:
  using Options = ContactOptions;

  /// Multipliers that this pair adds to the unknowns, and the first of them.
  virtual int numMultipliers() const = 0;
  int firstMultiplier() const { return firstMultiplier_; }

  /// What residuals of multipliers are compared with, one per multiplier: integrals of their functions over
  /// the reference face. With penalties, which have no multipliers, one per function.
  const Eigen::VectorXd& weights() const { return A_; }

  /// Makes this pair the one that keeps a tool with free degrees of freedom in touch with the body, without
  /// which its place is not determined: while nothing is active, here or in the tool's other pairs (which are
  /// evaluated before), the nearest function (or point) counts as active.
  void keepInTouch(std::vector<const ToolContact*> others);

  /// Gaps are measured from these values instead of zero: those with which a state that does not fit begins
  /// can be taken away little by little. One per function, of averaged gaps or of a field of gaps; empty:
  /// from zero.
  void measureGapsFrom(Eigen::VectorXd origin) { gapOrigin_ = std::move(origin); }

  /// Replaces ε. With an augmented Lagrangian the way into equilibrium depends on it, the equilibrium does
  /// not.
  void setParameter(double parameter) { options_.parameter = parameter; }
  double parameter() const { return *options_.parameter; }

  const ContactState& state() const { return state_; }
  const FaceQuadrature<Dim>& face() const { return face_; }
  const Options& options() const { return options_; }

  /// Gaps between the undeformed face and the tool at a place, one per function: averaged ones, or those at
  /// the functions' anchors.
  virtual Eigen::VectorXd referenceGaps(const ToolPose& pose) const = 0;

  /// Smallest gap between the undeformed face and the tool at a place, of those that the method closes:
  /// averaged ones, or those of points.
  virtual double smallestReferenceGap(const ToolPose& pose) const = 0;

 protected:
  /// options: with a parameter.
  ToolContact(const Body<Dim>& body, int patch, FaceId face, const Options& options, int firstMultiplier);

  /// Whether the tool touches the body nowhere else.
  bool isAlone() const;

  FaceQuadrature<Dim> face_;
  Options options_;
  int firstMultiplier_;
  bool axisymmetric_;
  Eigen::VectorXd A_;
  Eigen::VectorXd gapOrigin_;
  bool keepsInTouch_ = false;
  std::vector<const ToolContact*> others_;
  ContactState state_;
};

/// The pair of a face and a tool as the options want it. options: with a parameter. firstMultiplier: number
/// of the first of the pair's multipliers among the unknowns. held: displacement components that supports
/// prescribe. Body and tool must outlive the term. Throws `Error` as the term of the method.
template <int Dim>
std::unique_ptr<ToolContact<Dim>> makeToolContact(const Body<Dim>& body, int patch, FaceId face,
                                                  const Tool& tool, const ContactOptions& options,
                                                  int firstMultiplier, const std::vector<bool>& held);

/// Mean distance of neighbouring control points of a face, over both directions in space.
template <int Dim>
double meanControlPointDistance(const Patch<Dim>& patch, FaceId face);

}  // namespace burnish
