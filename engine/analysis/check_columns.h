#pragma once
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Columns that the quantities wanted of a scene name and that a history with these columns does not have,
/// each with its key, the nearest column and all of them.
std::vector<InputProblem> unknownColumns(const Scene& scene, const std::vector<std::string>& columns);

}  // namespace burnish::inline analysis
