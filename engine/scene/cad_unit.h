#pragma once
#include <optional>
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// The unit, such as "mm", into which lengths of a CAD file are converted for a scene: that of `units`, millimetres without a
/// label. One that names no unit is added to `errors`, and nothing is returned. path: of what has the file.
std::optional<std::string> cadUnitOf(const YamlNode& root, const std::string& path, Diagnostics& errors);

}  // namespace burnish::inline scene
