#include "cli/scene_input.h"

#include "engine/scene/scene_reading.h"

namespace burnish {

bool isStandardInput(const std::filesystem::path& file) {
  return file == "-";
}

SceneDocument readSceneInput(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (!isStandardInput(file)) return readSceneDocument(file, overrides);
  return parseSceneDocument(readDocument("/dev/stdin", kSceneKind), "standard input", overrides);
}

}  // namespace burnish
