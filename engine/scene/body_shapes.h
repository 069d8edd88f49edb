#pragma once
#include <string>

#include "engine/schema/yaml_tree.h"

namespace burnish::inline scene {

/// Calls `act(shape, path)` for every shape of bodies in a scene's tree: those of `geometry`, of its patches, and of
/// `bodies`.
template <class Act>
void forEachBodyShape(YamlNode& root, const Act& act) {
  const auto ofGeometry = [&](YamlNode& body, const std::string& prefix) {
    YamlNode* geometry = body.find("geometry");
    if (geometry == nullptr) return;
    const std::string path = prefix + "geometry";
    act(*geometry, path);
    YamlNode* patches = geometry->find("patches");
    if (patches == nullptr || patches->kind != YamlNode::Kind::Sequence) return;
    for (std::size_t i = 0; i < patches->children.size(); ++i)
      act(patches->children[i], path + ".patches[" + std::to_string(i) + "]");
  };
  ofGeometry(root, "");
  YamlNode* bodies = root.find("bodies");
  if (bodies == nullptr || bodies->kind != YamlNode::Kind::Sequence) return;
  for (std::size_t k = 0; k < bodies->children.size(); ++k)
    ofGeometry(bodies->children[k], "bodies[" + std::to_string(k) + "].");
}

}  // namespace burnish::inline scene
