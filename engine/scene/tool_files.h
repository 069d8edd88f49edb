#pragma once
#include <filesystem>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Makes the names of the files that shapes of tools are read from, which are relative to `directory`,
/// absolute in a scene's tree, so that the resolved scene, which results keep, can be run from anywhere. Those
/// of CAD that say no `unit` get that of the scene's lengths; a label that names no unit is added to `errors`.
void resolveToolFiles(YamlNode& root, const std::filesystem::path& directory, Diagnostics& errors);

/// Calls `act(shape, path)` for every shape of the tools in a scene's tree, parts of unions included.
template <class Act>
void forEachToolShape(YamlNode& root, const Act& act) {
  const auto forEach = [](YamlNode& holder, const std::string& key, const std::string& path,
                          const auto& visit) {
    for (YamlNode& list : holder.children)
      if (list.key == key && list.kind == YamlNode::Kind::Sequence)
        for (std::size_t i = 0; i < list.children.size(); ++i)
          visit(list.children[i], path + "[" + std::to_string(i) + "]");
  };
  forEach(root, "tools", "tools", [&](YamlNode& tool, const std::string& path) {
    act(tool, path);
    forEach(tool, "parts", path + ".parts", act);
  });
}

}  // namespace burnish::inline scene
