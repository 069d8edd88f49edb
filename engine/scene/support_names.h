#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// What the supports of a scene are called in results: by their names, else support1, support2, … by their
/// places in the list.
std::vector<std::string> supportNames(const Scene& scene);

}  // namespace burnish::inline scene
