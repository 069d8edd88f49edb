#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// Keys of a scene's file that the engine leaves to others, see `SceneDocument`.
inline std::vector<std::string> keysOfDocuments() {
  return {"pictures", "probes", "variants", "checks", "charts"};
}

/// Reads and checks what the engine needs of a scene. `overrides` are "path.to[1].key=value" each, the value
/// as YAML, applied in order before anything is checked. Throws one `Error` with a line for everything that
/// is wrong: `FILE:LINE:COLUMN: key.path: what was found; what is allowed`, or `--set path=value: ...` for an
/// override.
Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same for a scene in memory; `name` stands for the file in messages.
Scene parseScene(const std::string& yaml, const std::string& name,
                 const std::vector<std::string>& overrides = {});

}  // namespace burnish::inline scene
