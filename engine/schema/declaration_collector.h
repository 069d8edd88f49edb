#pragma once
#include <variant>

#include "engine/schema/declaration.h"
#include "engine/schema/leaf_writer.h"

namespace burnish::inline schema {

template <class T>
ValueType typeOf() {
  using Kind = ValueType::Kind;
  if constexpr (Optional<T>) {
    return typeOf<typename T::value_type>();
  } else if constexpr (Spelled<T>) {
    return {.kind = Kind::Text};
  } else if constexpr (List<T>) {
    ValueType type = typeOf<typename ListTraits<T>::Item>();
    ++type.lists;
    type.length = ListTraits<T>::length;
    type.singleToo = IsOneOrMore<T>::value;
    return type;
  } else if constexpr (std::is_same_v<T, Coordinates>) {
    return typeOf<std::vector<double>>();
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return typeOf<std::array<double, 3>>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return {.kind = Kind::Truth};
  } else if constexpr (std::is_integral_v<T>) {
    return {.kind = Kind::Whole};
  } else if constexpr (std::is_floating_point_v<T>) {
    return {.kind = Kind::Number};
  } else if constexpr (std::is_same_v<T, FormulaText>) {
    return {.kind = Kind::Formula};
  } else if constexpr (std::is_enum_v<T>) {
    return {.kind = Kind::Choice};
  } else if constexpr (std::is_same_v<T, std::string>) {
    return {.kind = Kind::Text};
  } else {
    return {.kind = Kind::Mapping};
  }
}

/// The struct or leaf inside optionals and lists.
template <class T>
struct Underlying {
  using Type = T;
};
template <Optional T>
struct Underlying<T> : Underlying<typename T::value_type> {};
template <List T>
struct Underlying<T> : Underlying<typename ListTraits<T>::Item> {};

/// Visitor that collects the keys of a struct, every alternative of a variant included.
class DeclarationCollector {
 public:
  static constexpr bool declares = true;

  explicit DeclarationCollector(Declarations& out) : out_(out) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* sentence) {
    using Inner = typename Underlying<T>::Type;
    Declaration& added = out_.emplace_back(Declaration{key, sentence, allowedText<T>(rule), typeOf<T>(),
                                                       ruleOf<Inner>(rule), defaultOf(value, rule)});
    if constexpr (std::is_enum_v<Inner>) added.rule.choices = enumNames<Inner>();
    if constexpr (!Leaf<Inner>) added.below = declarationsOf<Inner>();
  }

  template <class... A>
  void alternatives(const char* key, std::variant<A...>& /*value*/,
                    const std::array<Alternative, sizeof...(A)>& alternatives, const char* sentence) {
    Rule rule{.required = true};
    for (const Alternative& a : alternatives) rule.choices.push_back(a.name);
    Declaration chooser{key,  sentence,    allowedText<std::string>(rule), {.kind = ValueType::Kind::Choice},
                        rule, std::nullopt};
    const auto* next = alternatives.data();
    (chooser.alternatives.push_back({*next++, declarationsOf<A>()}), ...);
    out_.push_back(std::move(chooser));
  }

  /// All keys of a T with the defaults of a fresh one.
  template <class T>
  static Declarations declarationsOf() {
    Declarations keys;
    T fresh{};
    DeclarationCollector collector(keys);
    describe(collector, fresh);
    return keys;
  }

 private:
  template <class T>
  static std::optional<std::string> defaultOf(const T& value, const Rule& rule) {
    if constexpr (!Leaf<T>) {
      return std::nullopt;
    } else {
      if (rule.required) return std::nullopt;
      if constexpr (Spelled<T>)
        if (Spelling<T>::write(value).empty()) return std::nullopt;
      if constexpr (MayBeEmpty<T>)
        if (value.empty()) return std::nullopt;
      YAML::Emitter text;
      writeLeaf(text, value, rule);
      return text.c_str();
    }
  }

  Declarations& out_;
};

/// Every key of a document that fills a T.
template <class T>
Declarations declarationsOf() {
  return DeclarationCollector::declarationsOf<T>();
}

}  // namespace burnish::inline schema
