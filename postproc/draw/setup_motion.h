#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish {

/// The straight parts of a motion in the plane until the time `end`, in their order: displacement of each.
std::vector<Eigen::Vector2d> motionPhases(const MotionSpec& motion, double end);

}  // namespace burnish
