#pragma once
#include <Eigen/Dense>
#include <array>
#include <string>

#include "engine/contact/rigid_shape.h"
#include "engine/core/schedule.h"

namespace burnish {

/// A rigid tool that moves as prescribed.
struct Tool {
  std::string name;
  RigidShape shape;                ///< at its reference position
  std::array<Schedule, 3> motion;  ///< displacement components from t = 0 on

  /// Before t = 0 the tool may come down from a lifted position: displacement `lift` at t = -approachTime,
  /// going linearly to zero at t = 0.
  Eigen::Vector3d lift = Eigen::Vector3d::Zero();
  double approachTime = 0.0;

  Eigen::Vector3d displacement(double t) const;

  /// Gap, normal and curvature for a point x at time t.
  GapQuery query(double t, const Eigen::Vector3d& x) const { return queryGap(shape, x - displacement(t)); }
};

}  // namespace burnish
