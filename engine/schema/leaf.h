#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/core/enum_names.h"
#include "engine/core/formula.h"
#include "engine/core/shown_text.h"
#include "engine/schema/coordinates.h"
#include "engine/schema/one_or_more.h"
#include "engine/schema/rule.h"

/// The types that a single key of a scene may have: numbers, truth values, texts, formulas, named choices,
/// lists of these; points and directions, with an entry per dimension; vectors of three entries.
namespace burnish::inline schema {

template <class T>
struct ListTraits : std::false_type {};
template <class T>
struct ListTraits<std::vector<T>> : std::true_type {
  using Item = T;
  static constexpr std::size_t length = 0;
};
template <class T>
struct ListTraits<OneOrMore<T>> : ListTraits<std::vector<T>> {};
template <class T, std::size_t N>
struct ListTraits<std::array<T, N>> : std::true_type {
  using Item = T;
  static constexpr std::size_t length = N;
};

/// Specialised for a type that is written as one text with a spelling of its own, such as a plane, "z=2.5":
/// `read(text)`, the value, or nothing for a text that is none (throws `Error` if it is one that cannot be
/// used); `write(value)`, a text that reads back to it, empty for none; `words()`, what is allowed;
/// `candidates()`, words to propose.
template <class T>
struct Spelling;

template <class T>
concept Spelled = requires(const std::string& text, const T& value) {
  { Spelling<T>::read(text) } -> std::same_as<std::optional<T>>;
  { Spelling<T>::write(value) } -> std::same_as<std::string>;
};

template <class T>
concept List = ListTraits<T>::value && !Spelled<T>;

template <class T>
struct IsOneOrMore : std::false_type {};
template <class T>
struct IsOneOrMore<OneOrMore<T>> : std::true_type {};

template <class T>
struct OptionalTraits : std::false_type {};
template <class T>
struct OptionalTraits<std::optional<T>> : std::true_type {};

template <class T>
concept Optional = OptionalTraits<T>::value;

template <class T>
struct IsLeaf
    : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>> {};
template <>
struct IsLeaf<FormulaText> : std::true_type {};
template <>
struct IsLeaf<Coordinates> : std::true_type {};
template <>
struct IsLeaf<Eigen::Vector3d> : std::true_type {};
template <Spelled T>
struct IsLeaf<T> : std::true_type {};
template <List T>
struct IsLeaf<T> : IsLeaf<typename ListTraits<T>::Item> {};

template <class T>
concept Leaf = IsLeaf<T>::value;

/// Leaves that are left out where they have no entries.
template <class T>
concept MayBeEmpty = List<T> || std::is_same_v<T, Coordinates>;

/// The rule of a leaf, with what its type implies.
template <class T>
Rule ruleOf(Rule rule) {
  if constexpr (std::is_same_v<T, Coordinates>) rule.perDimension = true;
  return rule;
}

/// A visitor that fills the struct. When it has read a key that chooses the defaults of others, `describe`
/// sets these, and what is stated then replaces them.
template <class Visitor>
concept Fills = requires {
  requires Visitor::fills;
};

template <class E>
std::vector<std::string> enumNames() {
  std::vector<std::string> names;
  for (const auto& [name, value] : kNamesOf<E>) names.emplace_back(name);
  return names;
}

/// What is allowed for a value of type T, in words: "a number above 0", "a list of 2 whole numbers", "a
/// mapping".
template <class T>
std::string allowedText(const Rule& rule, bool plural = false) {
  if constexpr (Optional<T>) {
    return allowedText<typename T::value_type>(rule, plural);
  } else if constexpr (Spelled<T>) {
    return plural ? "texts" : "a text";
  } else if constexpr (List<T>) {
    using Item = typename ListTraits<T>::Item;
    if constexpr (IsOneOrMore<T>::value)
      return fmt::format("{}, or {}", allowedText<Item>(rule, plural),
                         allowedText<std::vector<Item>>(rule, plural));
    const std::size_t length = ListTraits<T>::length;
    const std::string count = length > 0 ? fmt::format("{} ", length) : rule.entries();
    return fmt::format("{} of {}{}{}{}", plural ? "lists" : "a list", count,
                       rule.increasing ? "increasing " : "", allowedText<Item>(rule.ofEntry(), true),
                       rule.perDimension ? ", one per dimension" : "");
  } else if constexpr (std::is_same_v<T, Coordinates>) {
    return allowedText<std::vector<double>>(ruleOf<T>(rule), plural);
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return allowedText<std::array<double, 3>>(rule, plural);
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return (plural ? "whole numbers" : "a whole number") + rule.range();
  } else if constexpr (std::is_floating_point_v<T>) {
    return (plural ? "numbers" : "a number") + rule.range();
  } else if constexpr (std::is_same_v<T, FormulaText>) {
    return plural ? "numbers or formulas" : "a number or a formula";
  } else if constexpr (std::is_enum_v<T>) {
    return fmt::format("{}", fmt::join(enumNames<T>(), " | "));
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!rule.choices.empty())
      return fmt::format("{}{}", plural ? "entries out of " : "", fmt::join(rule.choices, " | "));
    if (rule.identifier) return "a name of letters, digits, - and _";
    return (plural ? "texts" : "a text") +
           (rule.longest > 0 ? fmt::format(" of up to {} letters", rule.longest) : "");
  } else {
    return plural ? "mappings" : "a mapping";
  }
}

}  // namespace burnish::inline schema
