#pragma once
#include <string>

#include "engine/results/result_reader.h"
#include "engine/scene/scene.h"

namespace burnish {

/// Model, frames, fields and history of a result, a few lines.
std::string resultText(const ResultReader& result);

/// The scene with every default filled in, as YAML.
std::string sceneText(const Scene& scene);

}  // namespace burnish
