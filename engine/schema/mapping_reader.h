#pragma once
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/schema/leaf_reader.h"

namespace burnish::inline schema {

/// A list that must have one entry per dimension, which is known only when the geometry has been read.
struct DimensionedList {
  Place place;
  std::string path;
  std::size_t entries;
};

/// Visitor that fills a struct from one mapping of the scene. What is wrong goes to the diagnostics.
class MappingReader {
 public:
  static constexpr bool fills = true;

  MappingReader(const YamlNode& node, std::string path, Diagnostics& errors,
                std::vector<DimensionedList>& dimensioned)
      : node_(node), path_(std::move(path)), errors_(errors), dimensioned_(dimensioned) {}

  /// Reads all fields of a struct, then judges keys that no field has asked for. leftToOthers: keys that
  /// somebody else reads.
  template <class T>
  void readInto(T& value, const std::vector<std::string>& leftToOthers = {}) {
    describe(*this, value);
    reportMissing();
    known_.insert(known_.end(), leftToOthers.begin(), leftToOthers.end());
    if (keysAreKnown_) rejectUnknownKeys();
  }

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    const YamlNode* node = look(key, rule, allowedText<T>(rule));
    if (node != nullptr) read(*node, pathOf(key), value, rule);
  }

  template <class... A>
  void alternatives(const char* key, std::variant<A...>& value,
                    const std::array<Alternative, sizeof...(A)>& alternatives, const char* /*sentence*/) {
    Rule rule{.required = true};
    for (const Alternative& a : alternatives) rule.choices.push_back(a.name);
    const YamlNode* node = look(key, rule, allowedText<std::string>(rule));
    std::string name;
    if (node != nullptr) LeafReader(errors_).read(*node, pathOf(key), name, rule);
    keysAreKnown_ = !name.empty();
    if (keysAreKnown_) readAlternative(name, value, alternatives, std::index_sequence_for<A...>());
  }

 private:
  template <class T>
  void read(const YamlNode& node, const std::string& path, std::optional<T>& value, const Rule& rule) {
    // An override takes a mapping away with `null`; a file in which only its key is left is a mistake.
    if (node.kind == YamlNode::Kind::Null && (Leaf<T> || node.place.source != 0)) return;
    read(node, path, value.emplace(), rule);
  }

  template <Leaf T>
  void read(const YamlNode& node, const std::string& path, T& value, const Rule& rule) {
    LeafReader(errors_).read(node, path, value, rule);
    if (ruleOf<T>(rule).perDimension && errors_.clean(path))
      dimensioned_.push_back({node.place, path, node.children.size()});
  }

  template <class T>
  requires(!Leaf<std::vector<T>>) void read(const YamlNode& node, const std::string& path,
                                            std::vector<T>& value, const Rule& rule) {
    if (node.kind != YamlNode::Kind::Sequence || !rule.admitsEntries(node.children.size()))
      return LeafReader(errors_).reject(node, path, allowedText<std::vector<T>>(rule));
    for (std::size_t i = 0; i < node.children.size(); ++i)
      read(node.children[i], fmt::format("{}[{}]", path, i), value.emplace_back(), {});
  }

  template <class T>
  void read(const YamlNode& node, const std::string& path, OneOrMore<T>& value, const Rule& rule) {
    const bool isList = node.kind == YamlNode::Kind::Sequence && !node.children.empty();
    if (!isList && node.kind != YamlNode::Kind::Mapping)
      return LeafReader(errors_).reject(node, path, allowedText<OneOrMore<T>>(rule));
    if (!isList) return read(node, path, value.emplace_back(), {});
    for (std::size_t i = 0; i < node.children.size(); ++i)
      read(node.children[i], fmt::format("{}[{}]", path, i), value.emplace_back(), {});
  }

  template <class T>
  requires(!Leaf<T>) void read(const YamlNode& node, const std::string& path, T& value, const Rule& rule) {
    if (node.kind != YamlNode::Kind::Mapping)
      return LeafReader(errors_).reject(node, path, allowedText<T>(rule));
    MappingReader(node, path, errors_, dimensioned_).readInto(value);
  }

  template <class... A, std::size_t... I>
  void readAlternative(const std::string& name, std::variant<A...>& value,
                       const std::array<Alternative, sizeof...(A)>& alternatives, std::index_sequence<I...>) {
    const auto readIf = [&]<std::size_t K>() {
      if (name == alternatives[K].name) describe(*this, value.template emplace<K>());
    };
    (readIf.template operator()<I>(), ...);
  }

  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  /// Value of a key; remembers that the key exists and reports it when it is required and missing.
  const YamlNode* look(const char* key, const Rule& rule, const std::string& allowed);
  void rejectUnknownKeys();

  /// Of a mapping without any key what is missing is told together.
  void reportMissing();
  void reportMissing(const std::string& key, const std::string& required);

  struct MissingKey {
    std::string key, required;
  };

  const YamlNode& node_;
  std::string path_;
  Diagnostics& errors_;
  std::vector<DimensionedList>& dimensioned_;
  std::vector<std::string> known_;
  std::vector<MissingKey> missing_;  ///< of an empty mapping
  bool keysAreKnown_ = true;         ///< false when the key that chooses an alternative is unusable
};

}  // namespace burnish::inline schema
