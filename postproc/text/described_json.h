#pragma once
#include <json/value.h>

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/schema/rule.h"

namespace burnish {

/// Visitor that makes a JSON object of a struct that describes itself; what is empty and not required is left out.
class DescribedJson {
 public:
  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* /*sentence*/) {
    if (!rule.required && isEmpty(value)) return;
    object[key] = jsonOf(value);
  }

  Json::Value object{Json::objectValue};

 private:
  template <class T>
  static bool isEmpty(const T& value) {
    if constexpr (requires { value.empty(); }) return value.empty();
    if constexpr (requires { value.has_value(); }) return !value.has_value();
    return false;
  }

  template <class T>
  static Json::Value jsonOf(T& value) {
    if constexpr (std::same_as<T, std::string> || std::same_as<T, bool> || std::floating_point<T>) {
      return value;
    } else if constexpr (std::integral<T>) {
      return static_cast<Json::Int64>(value);
    } else if constexpr (requires { value.has_value(); }) {
      return jsonOf(*value);
    } else if constexpr (requires { value.push_back(value.front()); }) {
      Json::Value list(Json::arrayValue);
      for (auto& item : value) list.append(jsonOf(item));
      return list;
    } else {
      DescribedJson inner;
      describe(inner, value);
      return inner.object;
    }
  }
};

template <class T>
Json::Value describedJson(T value) {
  DescribedJson json;
  describe(json, value);
  return json.object;
}

}  // namespace burnish
