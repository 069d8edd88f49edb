#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/tools/rigid_shape.h"

namespace burnish::inline tools {

/// Degrees of freedom of a tool: displacements of its pivot along x, y and z, and the turn about the axis
/// through the pivot.
inline constexpr std::size_t kToolDofs = 4;
inline constexpr std::size_t kTurn = 3;

/// Of a tool that follows a surface: its way along the normal, in place of the displacement along x. It has no other
/// free displacement.
inline constexpr std::size_t kNormal = 0;

/// Those of a ball that spins: its turns about x, y and z come behind.
inline constexpr std::size_t kSpin = kToolDofs;
inline constexpr std::size_t kSpins = 3;
inline constexpr std::size_t kAllToolDofs = kToolDofs + kSpins;

/// Place of a rigid tool: turned about the axis through its pivot, then displaced.
struct ToolPose {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  double angle = 0.0;  ///< radians

  /// Of a ball that spins: its turns about x, y and z, added up step by step (radians). They are no orientation,
  /// which does not matter for a ball; how it turns within a step is `turned` of their difference.
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();

  /// Of a tool that follows a surface: the surface's normal, a unit vector, and the way along it, which is part of the
  /// displacement.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double alongNormal = 0.0;
};

/// A turn by a rotation vector θ (radians), of at most half a turn, with its derivative: δφ = byVector δθ, where
/// the turned vector y moves by δφ × y.
struct TurnByVector {
  Eigen::Matrix3d rotation, byVector;
};
TurnByVector turned(const Eigen::Vector3d& theta);

/// Gap at a point and its derivatives with respect to the point and to the degrees of freedom of the tool.
struct ToolGap {
  GapQuery point;                                  ///< with respect to the point
  Eigen::Vector<double, kToolDofs> dDofs;          ///< ∂g/∂q
  Eigen::Matrix<double, 3, kToolDofs> dNormal;     ///< ∂n/∂q
  Eigen::Matrix<double, kToolDofs, kToolDofs> d2;  ///< ∂²g/∂q²
};

/// A rigid tool: its degrees of freedom are prescribed in time, or free and then unknowns of the problem.
struct Tool {
  std::string name;
  RigidShape shape;  ///< at its reference position
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();

  /// Prescribed degrees of freedom from t = 0 on, the turn in radians; at rest where empty.
  std::array<std::function<double(double)>, kToolDofs> motion{};

  /// Normal in time of the surface that the tool follows, away from the body; empty for others. Its motion takes it
  /// along the surface, and from there it is free along the normal: u = u_motion(t) + ζ n(t).
  std::function<Eigen::Vector3d(double)> normal{};

  /// Numbers of the unknowns of the free degrees of freedom; -1 for prescribed ones. The unknowns of turns are
  /// angles times `turnLength`, so that all unknowns are lengths and their residuals forces.
  std::array<int, kAllToolDofs> unknowns{-1, -1, -1, -1, -1, -1, -1};
  double turnLength = 1.0;

  /// Before t = 0 the tool may come down from a lifted position: displacement `lift` at t = -approachTime,
  /// going linearly to zero at t = 0.
  Eigen::Vector3d lift = Eigen::Vector3d::Zero();
  double approachTime = 0.0;

  bool isFree(std::size_t dof) const { return unknowns[dof] >= 0; }

  bool followsSurface() const { return static_cast<bool>(normal); }

  /// Unit vector along which a displacement that is free goes.
  Eigen::Vector3d direction(std::size_t dof, const ToolPose& pose) const {
    return followsSurface() ? pose.normal : Eigen::Vector3d::Unit(static_cast<Eigen::Index>(dof));
  }

  /// Whether it is a ball that turns freely about all axes through its pivot, its middle. No gap depends on that.
  bool spins() const { return isFree(kSpin); }

  /// Unknowns of the free degrees of freedom, in their order.
  std::vector<int> freeUnknowns() const;

  /// Place at time t; x: values of all unknowns, used by free degrees of freedom alone.
  ToolPose pose(double t, const Eigen::VectorXd& x) const;

  /// Place at time t of a tool whose free degrees of freedom are at zero.
  ToolPose pose(double t) const;

  /// A point that is at x, in the tool's reference position.
  Eigen::Vector3d toReference(const ToolPose& pose, const Eigen::Vector3d& x) const;

  /// Gap, normal and curvature for a point x.
  GapQuery query(const ToolPose& pose, const Eigen::Vector3d& x) const;

  /// The same with the derivatives by the tool's degrees of freedom, theory: ∂g/∂q = -n·w, w the velocity of
  /// the tool's matter at x.
  ToolGap queryWithDofs(const ToolPose& pose, const Eigen::Vector3d& x) const;
};

}  // namespace burnish::inline tools
