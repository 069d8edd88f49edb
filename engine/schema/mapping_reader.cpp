#include "engine/schema/mapping_reader.h"

#include <algorithm>

namespace burnish::inline schema {

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
  if (node == nullptr && rule.required && !isReplaced) {
    const std::string required = allowed + (rule.unless.empty() ? "" : ", or the key " + rule.unless);
    if (node_.children.empty())
      missing_.push_back({key, required});
    else
      reportMissing(key, required);
  }
  return node;
}

void MappingReader::reportMissing(const std::string& key, const std::string& required) {
  errors_.add(node_.place, pathOf(key), fmt::format("missing; required: {}.", required));
}

void MappingReader::reportMissing() {
  if (missing_.size() == 1 || path_.empty()) {
    for (const auto& [key, required] : missing_) reportMissing(key, required);
  } else if (!missing_.empty()) {
    std::vector<std::string> keys;
    for (const auto& [key, required] : missing_) keys.push_back(fmt::format("{} ({})", key, required));
    errors_.add(node_.place, path_, fmt::format("found nothing in it; required: {}.", fmt::join(keys, ", ")));
  }
}

void MappingReader::rejectUnknownKeys() {
  for (const YamlNode& child : node_.children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
      errors_.add(child.keyPlace, pathOf(child.key),
                  fmt::format("found an unknown key; allowed: {}.{}", fmt::join(known_, ", "),
                              isNumberBehindAComma(child) ? " Write numbers with a point, such as 0.3."
                                                          : didYouMean(child.key, known_)));
}

}  // namespace burnish::inline schema
