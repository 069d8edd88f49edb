#include "engine/scene/mapping_reader.h"

#include <algorithm>

namespace burnish {

const YamlNode* MappingReader::look(const char* key, const Rule& rule, const std::string& allowed) {
  known_.emplace_back(key);
  const YamlNode* node = node_.find(key);
  if (node == nullptr && rule.required)
    errors_.add(node_.place, pathOf(key), fmt::format("missing; required: {}.", allowed));
  return node;
}

void MappingReader::rejectUnknownKeys() {
  for (const YamlNode& child : node_.children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
      errors_.add(child.keyPlace, pathOf(child.key),
                  fmt::format("found an unknown key; allowed: {}.{}", fmt::join(known_, ", "),
                              didYouMean(child.key, known_)));
}

}  // namespace burnish
