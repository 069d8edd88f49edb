#pragma once
#include "engine/scene/tool_spec.h"

namespace burnish {

/// The path of a tool that has one, from its place in the scene. Throws `Error` if the shape cannot be made.
ToolPath pathOf(const ToolSpec& tool);

}  // namespace burnish
