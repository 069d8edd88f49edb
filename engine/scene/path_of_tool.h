#pragma once
#include <cstddef>
#include <optional>

#include "engine/scene/tool_spec.h"

namespace burnish::inline scene {

/// Point about which a tool turns, at its place in the scene. Throws `Error` if it is that of a shape that cannot be
/// made.
Eigen::Vector3d pivotOf(const ToolSpec& tool);

/// The path of a tool that has one, from its place in the scene. Throws `Error` if the shape cannot be made.
ToolPath pathOf(const ToolSpec& tool);

/// The displacement (0 for x, `kNormal` along the normal) in which a tool carries a force and its path lifts it, if there
/// is one: it sits in a holder there that follows the path and presses it on.
std::optional<std::size_t> dofInHolder(const ToolSpec& tool);

}  // namespace burnish::inline scene
