#pragma once
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace burnish::inline material {

/// What a document says about a law: the value of its key `law`, and a sentence.
struct LawKind {
  const char* key;
  const char* sentence;
};

/// What a law is made from: its `Parameters`, or the law itself if it is nothing but parameters.
template <class Law>
struct MadeFrom {
  using Type = Law;
};
template <class Law>
requires requires {
  typename Law::Parameters;
}
struct MadeFrom<Law> {
  using Type = typename Law::Parameters;
};

/// Laws of one sort, each with a `kind` of its own and a `describe` for what it is made from.
template <class... Law>
struct LawList {
  using Any = std::variant<Law...>;
  using Parameters = std::variant<typename MadeFrom<Law>::Type...>;

  /// A variant of something that there is for each law.
  template <template <class> class T>
  using Each = std::variant<T<Law>...>;

  /// Throws what the law throws that is made.
  static Any make(const Parameters& parameters) { return makeFrom<0>(parameters); }

  /// The key `law` of a mapping, whose value names one of the laws, and the keys of that one.
  template <class Visitor>
  static void describe(Visitor& v, Parameters& parameters, const char* sentence) {
    v.alternatives("law", parameters, {{{Law::kind.key, Law::kind.sentence}...}}, sentence);
  }

  /// Calls f with `std::type_identity` of the law that the parameters are those of.
  template <class F>
  static auto withLaw(const Parameters& parameters, const F& f) {
    return lawAt<0, Law...>(parameters, f);
  }

  /// Calls f with `std::type_identity` of every law.
  template <class F>
  static void forEachLaw(const F& f) {
    (f(std::type_identity<Law>{}), ...);
  }

 private:
  template <std::size_t Number, class First, class... Rest, class F>
  static auto lawAt(const Parameters& parameters, const F& f) {
    if constexpr (sizeof...(Rest) > 0)
      if (parameters.index() != Number) return lawAt<Number + 1, Rest...>(parameters, f);
    return f(std::type_identity<First>{});
  }

  template <std::size_t Number>
  static Any makeFrom(const Parameters& parameters) {
    if constexpr (Number + 1 < sizeof...(Law))
      if (parameters.index() != Number) return makeFrom<Number + 1>(parameters);
    return Any(std::in_place_index<Number>, std::get<Number>(parameters));
  }
};

}  // namespace burnish::inline material
