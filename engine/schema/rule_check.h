#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/input_error.h"
#include "engine/core/nearest.h"
#include "engine/schema/leaf.h"

namespace burnish::inline schema {

/// Visitor that holds the values of a struct that was made in code against their rules.
class RuleCheck {
 public:
  explicit RuleCheck(std::vector<InputProblem>& problems) : problems_(problems) {}

  template <class T>
  void field(const char* key, T& value, const Rule& rule, const char* sentence) {
    if constexpr (Optional<T>) {
      if (value) field(key, *value, rule, sentence);
    } else if constexpr (List<T>) {
      for (auto& entry : value) field(key, entry, rule.ofEntry(), sentence);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!rule.admits(value))
        report<T>(key, fmt::format("\"{}\"", value), rule, didYouMean(value, rule.choices));
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      const auto number = static_cast<double>(value);
      if (!std::isfinite(number) || !rule.admits(number)) report<T>(key, fmt::format("{}", value), rule, "");
    }
  }

 private:
  template <class T>
  void report(const char* key, const std::string& found, const Rule& rule, const std::string& hint) {
    problems_.push_back({key, fmt::format("found {}; allowed: {}.{}", found, allowedText<T>(rule), hint)});
  }

  std::vector<InputProblem>& problems_;
};

/// The values of the struct that its rules do not allow.
template <class T>
std::vector<InputProblem> ruleProblems(T value) {
  std::vector<InputProblem> problems;
  RuleCheck check(problems);
  describe(check, value);
  return problems;
}

}  // namespace burnish::inline schema
