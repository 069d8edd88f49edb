#pragma once
#include <string>
#include <variant>

#include "engine/scene/leaf_writer.h"

namespace burnish {

/// Visitor that lists the fields of a struct, every alternative of a variant included.
class MappingLister {
 public:
  MappingLister(std::string& out, int level) : out_(out), level_(level) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* sentence) {
    std::string type = allowedText<T>(rule);
    if (!rule.unit.empty()) type += " (" + rule.unit + ")";
    if (rule.required) type += ", required";
    if constexpr (Leaf<T>) type += defaultOf(value, rule);
    line(fmt::format("`{}`: {}. {}", key, type, sentence));
    listBelow(value);
  }

  template <class... A>
  void alternatives(const char* key, std::variant<A...>& /*value*/,
                    const std::array<Alternative, sizeof...(A)>& alternatives, const char* sentence) {
    line(fmt::format("`{}`: required. {} One of:", key, sentence));
    std::size_t index = 0;
    const auto listOne = [&]<class T>(T fresh) {
      const Alternative& alternative = alternatives[index++];
      std::string keys;
      MappingLister fields(keys, level_ + 2);
      describe(fields, fresh);
      MappingLister below(out_, level_ + 1);
      below.line(fmt::format("`{}: {}`: {}{}", key, alternative.name, alternative.sentence,
                             keys.empty() ? "" : " Its keys:"));
      out_ += keys;
    };
    (listOne(A{}), ...);
  }

 private:
  template <class T>
  static std::string defaultOf(const T& value, const Rule& rule) {
    if (rule.required) return "";
    if constexpr (List<T>)
      if (value.empty()) return "";
    YAML::Emitter text;
    writeLeaf(text, value, rule);
    return fmt::format(", default {}", text.c_str());
  }

  template <class T>
  void listBelow(T& /*value*/) {
    using Struct = typename Underlying<T>::Type;
    if constexpr (!Leaf<Struct>) {
      Struct fresh{};
      MappingLister below(out_, level_ + 1);
      describe(below, fresh);
    }
  }

  /// The struct or leaf inside optionals and lists.
  template <class T>
  struct Underlying {
    using Type = T;
  };
  template <class T>
  struct Underlying<std::optional<T>> : Underlying<T> {};
  template <class T>
  struct Underlying<std::vector<T>> : Underlying<T> {};

  void line(const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * level_), ' ') + "- " + text + "\n";
  }

  std::string& out_;
  int level_;
};

/// Every key of a document that fills a T, with its type, range, unit, default and meaning, as a nested
/// Markdown list.
template <class T>
std::string listKeys() {
  std::string out;
  T fresh{};
  MappingLister lister(out, 0);
  describe(lister, fresh);
  return out;
}

}  // namespace burnish
