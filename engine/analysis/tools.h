#pragma once
#include <memory>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/tools/tool.h"
#include "engine/tools/tool_load.h"

namespace burnish::inline analysis {

/// The tool of a scene. Its free degrees of freedom are numbered from `firstUnknown` on; bodySize scales the
/// unknown of a free turn.
std::unique_ptr<Tool> makeTool(const ToolSpec& spec, const Scene& scene, int firstUnknown, double bodySize);

/// What the tool carries; null for a tool without free degrees of freedom. bodySize: the longest displacement of a
/// step.
std::unique_ptr<ToolLoad> makeToolLoad(const ToolSpec& spec, const Scene& scene, const Tool& tool,
                                       double bodySize);

/// Times at which a motion or a load of the tool has a corner.
std::vector<double> cornersOf(const ToolSpec& spec);

}  // namespace burnish::inline analysis
