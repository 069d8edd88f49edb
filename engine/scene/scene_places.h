#pragma once
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/scene/scene.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Where the values of a scene stand: its files with all overrides applied.
struct ScenePlaces {
  YamlNode root;
  Diagnostics files;  ///< names of files and overrides; nothing is wrong
};

/// The problems, a line each, every path with its place: `FILE:LINE:COLUMN: path: ...`. A scene that was made
/// in code has no places; its paths stand alone.
std::string textWithPlaces(const Scene& scene, const std::vector<InputProblem>& problems);

}  // namespace burnish::inline scene
