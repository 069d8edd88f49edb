#include "engine/schema/mapping_reader.h"

#include <algorithm>

namespace burnish {

namespace {

/// What a decimal comma leaves behind in a mapping in braces: {nu: 0,3} has the key 3.
bool isNumberBehindAComma(const YamlNode& child) {
  return child.kind == YamlNode::Kind::Null && !child.key.empty() &&
         child.key.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

const YamlNode* MappingReader::look(const char* key, const Rule& rule, const std::string& allowed) {
  known_.emplace_back(key);
  const YamlNode* node = node_.find(key);
  const bool isReplaced = !rule.unless.empty() && node_.find(rule.unless) != nullptr;
  if (node == nullptr && rule.required && !isReplaced)
    errors_.add(node_.place, pathOf(key),
                fmt::format("missing; required: {}{}.", allowed,
                            rule.unless.empty() ? "" : ", or the key " + rule.unless));
  return node;
}

void MappingReader::rejectUnknownKeys() {
  for (const YamlNode& child : node_.children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
      errors_.add(child.keyPlace, pathOf(child.key),
                  fmt::format("found an unknown key; allowed: {}.{}", fmt::join(known_, ", "),
                              isNumberBehindAComma(child) ? " Write numbers with a point, such as 0.3."
                                                          : didYouMean(child.key, known_)));
}

}  // namespace burnish
