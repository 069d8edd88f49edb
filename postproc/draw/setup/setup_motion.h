#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish {

/// The straight parts of a motion in the plane until the time `end`, in their order: displacement of each.
std::vector<Eigen::Vector2d> motionPhases(const MotionSpec& motion, double end);

/// The same for a tool, where formulas have the part from begin to end.
std::vector<Eigen::Vector2d> motionPhases(const ToolSpec& tool,
                                          const std::vector<DefinitionSpec>& definitions, double end);

/// How far a tool turns until the time `end`, in degrees.
double turnOf(const ToolSpec& tool, const std::vector<DefinitionSpec>& definitions, double end);

/// The straight parts of the motion of a support at a point X of the body, where formulas have the part from
/// begin to end; none if it does not move there.
std::vector<Eigen::Vector2d> motionPhases(const SupportSpec& support, const Eigen::Vector2d& X,
                                          const std::vector<DefinitionSpec>& definitions, double end);

}  // namespace burnish
