#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/schema/diagnostics.h"

namespace burnish::inline schema {

/// A YAML document as a plain value: aliases expanded, every node with its place.
struct YamlNode {
  enum class Kind { Null, Scalar, Sequence, Mapping };

  Kind kind = Kind::Null;
  Place place{};
  std::string text{};   ///< of a scalar
  bool quoted = false;  ///< a scalar in quotes is never a number, a truth value or nothing
  std::string key{};    ///< of a value in a mapping
  Place keyPlace{};
  std::vector<YamlNode> children{};  ///< entries of a sequence or values of a mapping, in order

  /// Value of a key of a mapping, or null.
  const YamlNode* find(const std::string& name) const;
  YamlNode* find(const std::string& name);

  /// What stands here, in words, for messages.
  std::string describe() const;
};

/// Parses one YAML document. Malformed YAML, bytes that are no UTF-8, control characters, duplicate keys,
/// nesting beyond 50 levels and documents of more than a million nodes (aliases expanded) are added to
/// `errors`; without a value nothing could be read. `path` is where the document goes in the scene, for
/// messages.
std::optional<YamlNode> parseYaml(const std::string& text, int source, Diagnostics& errors,
                                  const std::string& path = "");

/// One step of a path such as `tools[0].radius`: a key or an index.
using PathStep = std::variant<std::string, std::size_t>;

/// Empty when the text is no path.
std::vector<PathStep> parsePath(const std::string& text);

/// Place of the value at a path, or of its closest ancestor that exists.
Place placeOf(const YamlNode& root, const std::string& path);

}  // namespace burnish::inline schema
