#pragma once
#include "engine/results/model_io.h"
#include "tests/engine/analysis/model_samples.h"

namespace burnish::fuzz {

/// The model whose frames are read.
inline StoredModel smallModel() {
  ModelRecord model = samples::modelOf(samples::quarterRing());
  model.program = "burnish";
  model.sceneYaml = "title: ring\n";
  model.tools = {{.name = "disc", .shape = Sphere{{0.0, 0.0, 0.0}, 1.0}}};
  return {.id = modelId(model), .record = std::move(model)};
}

}  // namespace burnish::fuzz
