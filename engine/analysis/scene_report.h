#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish {

/// What can be said of a scene without computing it.
struct SceneReport {
  std::string summary;                ///< dimension, basis, unknowns, tools
  std::vector<std::string> warnings;  ///< with their places: what is probably not meant
};

/// Builds the model of a scene. Throws `Error` if it cannot be computed, as `buildModel` does.
SceneReport reportOf(const Scene& scene);

}  // namespace burnish
