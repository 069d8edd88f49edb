#include "engine/scene/declaration.h"

#include <fmt/format.h>

namespace burnish {
namespace {

/// "a number above 0 (length), required" or "..., default 0.5".
std::string valueText(const Declaration& key) {
  std::string text = key.allowed;
  if (!key.rule.unit.empty()) text += " (" + key.rule.unit + ")";
  if (key.rule.required) text += ", required";
  if (key.defaultValue) text += ", default " + *key.defaultValue;
  return text;
}

void listLevel(const Declarations& keys, int level, std::string& out) {
  const auto line = [&out](int indent, const std::string& text) {
    out += std::string(2 * static_cast<std::size_t>(indent), ' ') + "- " + text + "\n";
  };
  for (const Declaration& key : keys) {
    if (key.alternatives.empty()) {
      line(level, fmt::format("`{}`: {}. {}", key.key, valueText(key), key.sentence));
      listLevel(key.below, level + 1, out);
      continue;
    }
    line(level, fmt::format("`{}`: required. {} One of:", key.key, key.sentence));
    for (const auto& [about, own] : key.alternatives) {
      line(level + 1, fmt::format("`{}: {}`: {}{}", key.key, about.name, about.sentence,
                                  own.empty() ? "" : " Its keys:"));
      listLevel(own, level + 2, out);
    }
  }
}

}  // namespace

std::string listKeys(const Declarations& keys) {
  std::string out;
  listLevel(keys, 0, out);
  return out;
}

}  // namespace burnish
