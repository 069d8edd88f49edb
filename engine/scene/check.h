#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Adds to `errors` what is wrong between the values of a scene: numbers of functions that the degree does
/// not allow, names that nothing has, lists of different length and the like. Values already found wrong are
/// left alone.
void checkScene(const Scene& scene, const YamlNode& root, Diagnostics& errors);

}  // namespace burnish::inline scene
