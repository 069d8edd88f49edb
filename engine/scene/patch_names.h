#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// Names of the patches of a body; none for a body of one patch.
std::vector<std::string> patchNames(const BodySpec& body);

}  // namespace burnish::inline scene
