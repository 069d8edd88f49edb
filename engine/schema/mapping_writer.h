#pragma once
#include <string>
#include <utility>
#include <variant>

#include "engine/schema/leaf_writer.h"

namespace burnish::inline schema {

/// Visitor that writes a struct as a mapping, every default spelled out. Optional values and empty lists that
/// are left out stay out.
class MappingWriter {
 public:
  explicit MappingWriter(YAML::Emitter& out) : out_(out) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    if constexpr (Optional<T>) {
      if (value) field(key, *value, rule, "");
    } else {
      if constexpr (Spelled<T>)
        if (Spelling<T>::write(value).empty()) return;
      if constexpr (MayBeEmpty<T>)
        if (value.empty()) return;
      if constexpr (std::is_same_v<T, std::string>)
        if (value.empty() && !rule.required) return;
      out_ << YAML::Key << key << YAML::Value;
      write(value, rule);
    }
  }

  template <class... A>
  void alternatives(const char* key, std::variant<A...>& value,
                    const std::array<Alternative, sizeof...(A)>& alternatives, const char* /*sentence*/) {
    out_ << YAML::Key << key << YAML::Value << alternatives[value.index()].name;
    std::visit([this](auto& alternative) { describe(*this, alternative); }, value);
  }

 private:
  template <class T>
  void write(T& value, const Rule& rule) {
    if constexpr (Leaf<T>) {
      writeLeaf(out_, value, rule);
    } else if constexpr (List<T>) {
      if constexpr (IsOneOrMore<T>::value)
        if (value.size() == 1) return write(value.front(), {});
      out_ << YAML::BeginSeq;
      for (auto& item : value) write(item, {});
      out_ << YAML::EndSeq;
    } else {
      out_ << YAML::BeginMap;
      describe(*this, value);
      out_ << YAML::EndMap;
    }
  }

  YAML::Emitter& out_;
};

/// A struct as a YAML document; reading it gives an equal one. By value: visitors take structs that they
/// could fill.
template <class T>
std::string yamlOf(T value) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  MappingWriter writer(out);
  describe(writer, value);
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace burnish::inline schema
