#pragma once
#include <yaml-cpp/yaml.h>

#include <string>

#include "engine/schema/leaf.h"

namespace burnish::inline schema {

/// Writes a leaf in one line: numbers with the fewest digits that read back exactly, texts in quotes.
template <Leaf T>
void writeLeaf(YAML::Emitter& out, const T& value, const Rule& rule) {
  if constexpr (std::is_same_v<T, Coordinates>) {
    writeLeaf(out, value.given(), rule);
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    writeLeaf(out, std::array{value.x(), value.y(), value.z()}, rule);
  } else if constexpr (Spelled<T>) {
    out << YAML::DoubleQuoted << Spelling<T>::write(value);
  } else if constexpr (List<T>) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const auto& item : value) writeLeaf(out, item, rule);
    out << YAML::EndSeq;
  } else if constexpr (std::is_enum_v<T>) {
    for (const auto& [name, candidate] : kNamesOf<T>)
      if (candidate == value) out << name;
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (rule.choices.empty() && !rule.identifier) out << YAML::DoubleQuoted;
    out << value;
  } else if constexpr (std::is_same_v<T, FormulaText>) {
    out << YAML::DoubleQuoted << value.text;
  } else if constexpr (std::is_floating_point_v<T>) {
    out << fmt::format("{}", value);
  } else {
    out << value;
  }
}

}  // namespace burnish::inline schema
