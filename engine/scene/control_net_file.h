#pragma once
#include <filesystem>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Puts the contents of the files that control nets (of bodies, of the curves and faces they are made from, and of tools) name into a
/// scene's tree, in place of the key `file` and those beside it. Names are relative to `directory`. A net that names a file and gives
/// other keys too, or neither, and files that do not hold a control net are added to `errors`.
void insertControlNetFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors);

}  // namespace burnish::inline scene
