#pragma once
#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/tools/rigid_shape.h"

namespace burnish {

/// The ways in which a tool moves: displacements of its pivot along x, y and z, and the turn about the axis
/// through the pivot.
inline constexpr std::size_t kToolWays = 4;
inline constexpr std::size_t kTurn = 3;

/// Place of a rigid tool: turned about the axis through its pivot, then displaced.
struct ToolPose {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  double angle = 0.0;  ///< radians
};

/// Gap at a point and its derivatives with respect to the point and to the free ways of the tool.
struct ToolGap {
  GapQuery point;                                  ///< with respect to the point
  Eigen::Vector<double, kToolWays> dWays;          ///< ∂g/∂q
  Eigen::Matrix<double, 3, kToolWays> dNormal;     ///< ∂n/∂q
  Eigen::Matrix<double, kToolWays, kToolWays> d2;  ///< ∂²g/∂q²
};

/// A rigid tool: its ways are prescribed in time, or free and then unknowns of the problem.
struct Tool {
  std::string name;
  RigidShape shape;  ///< at its reference position
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();

  /// Prescribed ways from t = 0 on, the turn in radians; at rest where empty.
  std::array<std::function<double(double)>, kToolWays> motion{};

  /// Numbers of the unknowns of the free ways; -1 for prescribed ones. The unknown of the turn is the angle
  /// times `turnLength`, so that all unknowns are lengths and their residuals forces.
  std::array<int, kToolWays> unknowns{-1, -1, -1, -1};
  double turnLength = 1.0;

  /// Before t = 0 the tool may come down from a lifted position: displacement `lift` at t = -approachTime,
  /// going linearly to zero at t = 0.
  Eigen::Vector3d lift = Eigen::Vector3d::Zero();
  double approachTime = 0.0;

  bool isFree(std::size_t way) const { return unknowns[way] >= 0; }

  /// Unknowns of the free ways, in their order.
  std::vector<int> freeUnknowns() const;

  /// Place at time t; x: values of all unknowns, used by free ways alone.
  ToolPose pose(double t, const Eigen::VectorXd& x) const;

  /// Place at time t of a tool whose free ways are at zero.
  ToolPose pose(double t) const;

  /// A point that is at x, in the tool's reference position.
  Eigen::Vector3d toReference(const ToolPose& pose, const Eigen::Vector3d& x) const;

  /// Gap, normal and curvature for a point x.
  GapQuery query(const ToolPose& pose, const Eigen::Vector3d& x) const;

  /// The same with the derivatives by the tool's ways, theory: ∂g/∂q = -n·w, w the velocity of the tool's
  /// matter at x.
  ToolGap queryWithWays(const ToolPose& pose, const Eigen::Vector3d& x) const;
};

}  // namespace burnish
