#pragma once
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Whether a time is given in words: `end` or `last`, the end of the run.
bool isEndOfRun(const std::string& text);

/// Puts `time` where a tree has such a word as the value of `time` or in a list of `times`.
void replaceEndOfRun(YamlNode& root, const std::string& time);

}  // namespace burnish::inline scene
