#pragma once
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline schema {

/// Sets one value of a scene's tree, "path.to[1].key=value" with the value as YAML. Mappings on the way that
/// do not exist are made, list entries must exist. `source` numbers the override in messages.
void applyOverride(YamlNode& root, const std::string& text, int source, Diagnostics& errors);

}  // namespace burnish::inline schema
