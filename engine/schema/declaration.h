#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/schema/rule.h"

/// What the `describe` of a document says, as a plain tree from which lists, schemas and explanations are
/// made.
namespace burnish::inline schema {

/// The type of a value: `kind` inside so many lists.
struct ValueType {
  enum class Kind { Truth, Whole, Number, Text, Formula, Choice, Mapping };

  Kind kind = Kind::Mapping;
  int lists = 0;
  std::size_t length = 0;  ///< of the outer list; any when 0
  bool singleToo = false;  ///< an entry of the outer list may stand for it
};

struct Declaration;

struct DeclaredAlternative {
  Alternative about;
  std::vector<Declaration> keys;
};

/// One key of a mapping.
struct Declaration {
  std::string key;
  std::string sentence;
  std::string allowed;  ///< in words
  ValueType type;
  Rule rule;                                ///< `choices` hold the names of an enumeration too
  std::optional<std::string> defaultValue;  ///< as YAML
  std::vector<Declaration> below{};         ///< keys of the mapping, or of each mapping in the list

  /// When the key chooses an alternative; the keys of that stand in the same mapping as this one.
  std::vector<DeclaredAlternative> alternatives{};
};

using Declarations = std::vector<Declaration>;

/// The keys as a nested Markdown list: type, range, unit, default and meaning. Alternatives that several keys
/// share are listed once, in sections behind the list.
std::string listKeys(const Declarations& keys);

}  // namespace burnish::inline schema
