#include "engine/scene/end_of_run.h"

namespace burnish::inline scene {
namespace {

void replaceScalar(YamlNode& node, const std::string& time) {
  if (node.kind != YamlNode::Kind::Scalar || !isEndOfRun(node.text)) return;
  node.text = time;
  node.quoted = false;
}

}  // namespace

bool isEndOfRun(const std::string& text) {
  return text == "end" || text == "last";
}

void replaceEndOfRun(YamlNode& root, const std::string& time) {
  for (YamlNode& child : root.children) {
    if (child.key == "time") replaceScalar(child, time);
    if (child.key == "times")
      for (YamlNode& entry : child.children) replaceScalar(entry, time);
    replaceEndOfRun(child, time);
  }
}

}  // namespace burnish::inline scene
