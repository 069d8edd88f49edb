#include "postproc/compare/data/data_rule.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"

namespace burnish {
namespace {

bool matchesPattern(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool matchesAny(const std::vector<std::string>& patterns, const std::string& name) {
  return std::ranges::any_of(patterns,
                             [&](const std::string& pattern) { return matchesPattern(pattern, name); });
}

/// NaN, which is no tolerance, for anything that is not a number.
double numberIn(const std::string& text) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size() ? value : std::nan("");
}

bool isTolerance(double value) {
  return std::isfinite(value) && value >= 0.0;
}

}  // namespace

FieldTolerance fieldToleranceFromText(const char* option, const std::string& text) {
  const std::size_t sign = text.rfind('=');
  const std::string numbers = sign == std::string::npos ? "" : text.substr(sign + 1);
  const std::size_t comma = numbers.find(',');
  FieldTolerance result{text.substr(0, sign), {numberIn(numbers.substr(0, comma)), 0.0}};
  if (comma != std::string::npos) result.tolerance.absolute = numberIn(numbers.substr(comma + 1));
  if (result.pattern.empty() || !isTolerance(result.tolerance.relative) ||
      !isTolerance(result.tolerance.absolute))
    throw Error(fmt::format(
        "{}: found {}; expected NAME=R or NAME=R,A with a relative and an absolute tolerance of at least 0, "
        "as in stress=1e-4",
        option, quoted(text)));
  return result;
}

void requireTolerance(const char* option, double value) {
  if (!isTolerance(value))
    throw Error(fmt::format("{}: found {}; expected a number of at least 0", option, value));
}

Tolerance toleranceOf(const DataRule& rule, const std::string& field) {
  Tolerance tolerance = rule.tolerance;
  for (const FieldTolerance& own : rule.fields)
    if (matchesPattern(own.pattern, field)) tolerance = own.tolerance;
  return tolerance;
}

bool isCompared(const DataRule& rule, const std::string& field) {
  return (rule.only.empty() || matchesAny(rule.only, field)) && !matchesAny(rule.skip, field);
}

void requireMatches(const DataRule& rule, const std::vector<std::string>& names) {
  std::vector<std::string> known;  // several pairs have the same
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0) known.push_back(name);
  const auto require = [&](const char* option, const std::string& pattern) {
    if (std::ranges::none_of(known, [&](const std::string& name) { return matchesPattern(pattern, name); }))
      throw Error(fmt::format("{}: found no field {}; expected one of {}.{}", option, quoted(pattern),
                              fmt::join(known, ", "), didYouMean(pattern, known)));
  };
  for (const FieldTolerance& own : rule.fields) require("--tolerance", own.pattern);
  for (const std::string& pattern : rule.only) require("--only", pattern);
  for (const std::string& pattern : rule.skip) require("--skip", pattern);
}

}  // namespace burnish
