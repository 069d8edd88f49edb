#pragma once
#include <filesystem>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Puts what profile files hold that the reliefs of a scene name (`file`) into the scene's tree, as `places` and
/// `heights`, in the scene's unit of lengths. Names are relative to `directory`. A file that holds no profile, or whose
/// unit cannot be converted, and keys beside `file` that it stands for are added to `errors`.
void insertProfileFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors);

}  // namespace burnish::inline scene
