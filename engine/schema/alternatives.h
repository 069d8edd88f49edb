#pragma once
#include <array>
#include <utility>
#include <variant>

#include "engine/schema/rule.h"

/// Variants whose alternatives say themselves what they are called: each has a static `kind` with a `key`,
/// the value by which a document chooses it, and a `sentence`.
namespace burnish::inline schema {

/// The least that a `kind` says.
struct PartKind {
  const char* key;
  const char* sentence;
};

template <class... Part>
std::array<Alternative, sizeof...(Part)> alternativesOf(const std::variant<Part...>& /*part*/) {
  return {Alternative{Part::kind.key, Part::kind.sentence}...};
}

template <class More, class... Part>
std::variant<Part..., More> orElse(const std::variant<Part...>& part);

/// The alternatives of a variant, and one more.
template <class Variant, class More>
using Extended = decltype(orElse<More>(std::declval<Variant>()));

}  // namespace burnish::inline schema
