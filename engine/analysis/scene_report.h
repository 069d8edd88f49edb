#pragma once
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/core/input_error.h"
#include "engine/scene/scene.h"

namespace burnish {

/// What can be said of a scene without computing it.
struct SceneReport {
  std::string summary;                ///< dimension, basis, unknowns, tools
  std::vector<std::string> warnings;  ///< with their places: what is probably not meant
};

/// What is probably not meant in a scene that can be computed, each with its key.
template <int Dim>
std::vector<InputProblem> sceneWarnings(const Scene& scene, const Model<Dim>& model);

/// The same as lines, each with its place in the scene's file.
std::vector<std::string> warningLines(const Scene& scene, const std::vector<InputProblem>& warnings);

/// Builds the model of a scene. Throws `Error` if it cannot be computed, as `buildModel` does.
SceneReport reportOf(const Scene& scene);

}  // namespace burnish
