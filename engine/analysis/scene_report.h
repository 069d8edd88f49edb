#pragma once
#include <string>
#include <vector>

#include "engine/analysis/cost_estimate.h"
#include "engine/analysis/model.h"
#include "engine/core/input_error.h"
#include "engine/results/result.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// What can be said of a scene without computing it.
struct SceneReport {
  std::string summary;                ///< dimension, basis, unknowns as `RunSummary` counts them, tools
  std::vector<std::string> warnings;  ///< with their places: what is probably not meant
  std::vector<std::string> columns;   ///< of its history
  ModelRecord model;                  ///< as a result has it
  CostEstimate cost;
};

/// What is probably not meant in a scene that can be computed, each with its key. columns: of its history.
template <int Dim>
std::vector<InputProblem> sceneWarnings(const Scene& scene, const Model<Dim>& model,
                                        const std::vector<std::string>& columns);

/// Throws `Error` with the places of what is wanted of columns that the history, with these columns, does not
/// have, unless that is worth a warning only.
void requireKnownColumns(const Scene& scene, const std::vector<std::string>& columns);

/// The same as lines, each with its place in the scene's file.
std::vector<std::string> warningLines(const Scene& scene, const std::vector<InputProblem>& warnings);

/// Builds the model of a scene. Throws `Error` if it cannot be computed, as a run does before it begins.
SceneReport reportOf(const Scene& scene);

/// The columns of the history alone. Throws as `reportOf` does.
std::vector<std::string> historyColumnsOf(const Scene& scene);

}  // namespace burnish::inline analysis
