#pragma once
#include "engine/scene/tool_spec.h"

namespace burnish {

/// Point about which a tool turns, at its place in the scene. Throws `Error` if it is that of a shape that cannot be
/// made.
Eigen::Vector3d pivotOf(const ToolSpec& tool);

/// The path of a tool that has one, from its place in the scene. Throws `Error` if the shape cannot be made.
ToolPath pathOf(const ToolSpec& tool);

}  // namespace burnish
