#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/cad/require_cad.h"
#include "engine/core/error.h"

namespace burnish::samples {

inline bool hasCad() {
  try {
    requireCad();
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// The scenes of scenes/examples; those with tools from CAD only where OpenCASCADE is there.
inline std::vector<std::filesystem::path> exampleScenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(BURNISH_SOURCE_DIR) / "scenes/examples")) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (hasCad() || text.find("shape: cad") == std::string::npos) scenes.push_back(entry.path());
  }
  return scenes;
}

}  // namespace burnish::samples
