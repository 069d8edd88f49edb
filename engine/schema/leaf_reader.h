#pragma once
#include <string>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/schema/leaf.h"
#include "engine/schema/yaml_tree.h"

namespace burnish::inline schema {

/// Reads leaves from YAML nodes; what does not fit is added to the diagnostics and leaves the value as it
/// was.
class LeafReader {
 public:
  explicit LeafReader(Diagnostics& errors) : errors_(errors) {}

  void read(const YamlNode& node, const std::string& path, double& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, int& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, bool& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, std::string& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, FormulaText& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, Coordinates& value, const Rule& rule);
  void read(const YamlNode& node, const std::string& path, Eigen::Vector3d& value, const Rule& rule);

  template <class E>
  requires std::is_enum_v<E>
  void read(const YamlNode& node, const std::string& path, E& value, const Rule& rule) {
    for (const auto& [name, candidate] : kNamesOf<E>) {
      if (node.kind == YamlNode::Kind::Scalar && node.text == name) {
        value = candidate;
        return;
      }
    }
    reject(node, path, allowedText<E>(rule), enumNames<E>());
  }

  template <Spelled T>
  void read(const YamlNode& node, const std::string& path, T& value, const Rule& rule) {
    if (node.kind != YamlNode::Kind::Scalar) return reject(node, path, allowedText<T>(rule));
    try {
      if (const auto found = Spelling<T>::read(node.text))
        value = *found;
      else
        errors_.add(node.place, path,
                    fmt::format("found \"{}\"; allowed: {}.{}", node.text, Spelling<T>::words(),
                                didYouMean(node.text, Spelling<T>::candidates())));
    } catch (const Error& error) {
      errors_.add(node.place, path, error.what());
    }
  }

  template <List T>
  void read(const YamlNode& node, const std::string& path, T& value, const Rule& rule) {
    constexpr std::size_t length = ListTraits<T>::length;
    const std::size_t entries = node.children.size();
    if (node.kind != YamlNode::Kind::Sequence || (length > 0 && entries != length) ||
        !rule.admitsEntries(entries))
      return reject(node, path, allowedText<T>(rule));
    T list{};
    if constexpr (length == 0) list.resize(entries);
    const Rule entryRule = rule.ofEntry();
    for (std::size_t i = 0; i < entries; ++i)
      read(node.children[i], fmt::format("{}[{}]", path, i), list[i], entryRule);
    if constexpr (std::is_arithmetic_v<typename ListTraits<T>::Item>)
      if (rule.increasing && errors_.clean(path)) requireIncreasing(node, path, list);
    value = std::move(list);
  }

  /// "found ...; allowed: ...", and the nearest of the candidates if one is close.
  void reject(const YamlNode& node, const std::string& path, const std::string& allowed,
              const std::vector<std::string>& candidates = {});

 private:
  template <class T>
  void requireIncreasing(const YamlNode& node, const std::string& path, const T& list) {
    for (std::size_t i = 1; i < list.size(); ++i)
      if (!(list[i] > list[i - 1]))
        return errors_.add(
            node.children[i].place, fmt::format("{}[{}]", path, i),
            fmt::format("found {} after {}; allowed: numbers that increase", list[i], list[i - 1]));
  }

  Diagnostics& errors_;
};

}  // namespace burnish::inline schema
