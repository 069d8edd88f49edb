#include "engine/schema/overrides.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace burnish::inline schema {
namespace {

/// The child at a step, made when it is a key that does not exist yet; a sentence when there is no way on.
std::variant<YamlNode*, std::string> descend(YamlNode& node, const PathStep& where, const Place& place) {
  if (const auto* key = std::get_if<std::string>(&where)) {
    if (node.kind == YamlNode::Kind::Null) node.kind = YamlNode::Kind::Mapping;
    if (node.kind != YamlNode::Kind::Mapping)
      return fmt::format(
          "\"{}\" is looked for in {}; a key needs a mapping, the entry of a list an index such as [0]", *key,
          node.describe());
    for (YamlNode& child : node.children)
      if (child.key == *key) return &child;
    node.children.push_back(YamlNode{.place = place, .key = *key, .keyPlace = place});
    return &node.children.back();
  }
  const std::size_t index = std::get<std::size_t>(where);
  if (node.kind != YamlNode::Kind::Sequence)
    return fmt::format("[{}] is looked for in {}; an index needs a list", index, node.describe());
  if (index >= node.children.size())
    return fmt::format("[{}] is looked for in {}; they are counted from 0", index, node.describe());
  return &node.children[index];
}

}  // namespace

void applyOverride(YamlNode& root, const std::string& text, int source, Diagnostics& errors) {
  const Place place{source, 1, 1};
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const auto path = parsePath(key);
  if (equals == std::string::npos || path.empty())
    return errors.add(place, "", "an override reads path=value, such as degree=3 or tools[0].radius=0.5");
  auto value = parseYaml(text.substr(equals + 1), source, errors, key);
  if (!value) return;

  YamlNode* node = &root;
  for (const PathStep& where : path) {
    auto next = descend(*node, where, place);
    if (const auto* problem = std::get_if<std::string>(&next)) return errors.add(place, key, *problem);
    node = std::get<YamlNode*>(next);
  }
  value->key = node->key;
  value->keyPlace = place;
  *node = *std::move(value);
}

}  // namespace burnish::inline schema
