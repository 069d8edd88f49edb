#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/tools/rigid_shape.h"

namespace burnish {

/// Degrees of freedom of a tool: displacements of its pivot along x, y and z, and the turn about the axis
/// through the pivot.
inline constexpr std::size_t kToolDofs = 4;
inline constexpr std::size_t kTurn = 3;

/// Place of a rigid tool: turned about the axis through its pivot, then displaced.
struct ToolPose {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  double angle = 0.0;  ///< radians
};

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

  /// Numbers of the unknowns of the free degrees of freedom; -1 for prescribed ones. The unknown of the turn
  /// is the angle times `turnLength`, so that all unknowns are lengths and their residuals forces.
  std::array<int, kToolDofs> unknowns{-1, -1, -1, -1};
  double turnLength = 1.0;

  /// Before t = 0 the tool may come down from a lifted position: displacement `lift` at t = -approachTime,
  /// going linearly to zero at t = 0.
  Eigen::Vector3d lift = Eigen::Vector3d::Zero();
  double approachTime = 0.0;

  bool isFree(std::size_t dof) const { return unknowns[dof] >= 0; }

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

}  // namespace burnish
