#include "engine/schema/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "engine/core/shown_text.h"

namespace burnish::inline schema {

bool Rule::admits(double value) const {
  return (!above || value > *above) && (!atLeast || value >= *atLeast) && (!below || value < *below) &&
         (!atMost || value <= *atMost);
}

bool Rule::admits(const std::string& value) const {
  if (!choices.empty()) return std::find(choices.begin(), choices.end(), value) != choices.end();
  if (!identifier) return true;
  return !value.empty() && std::all_of(value.begin(), value.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

bool Rule::admitsEntries(std::size_t entries) const {
  return entries >= minEntries && (maxEntries == 0 || entries <= maxEntries);
}

std::size_t Rule::mostLetters() const {
  return longest == 0 && identifier ? kLongestName : longest;
}

Rule Rule::ofEntry() const {
  Rule rule = *this;
  rule.minEntries = rule.maxEntries = 0;
  rule.increasing = rule.perDimension = false;
  return rule;
}

std::string Rule::entries() const {
  if (maxEntries > 0 && maxEntries == minEntries) return fmt::format("{} ", maxEntries);
  if (maxEntries > 0) return fmt::format("{} to {} ", minEntries, maxEntries);
  return minEntries > 0 ? fmt::format("{} or more ", minEntries) : "";
}

std::string Rule::range() const {
  if (atLeast && atMost) return fmt::format(" from {} to {}", *atLeast, *atMost);
  std::string lower, upper;
  if (above) lower = fmt::format(" above {}", *above);
  if (atLeast) lower = fmt::format(" at least {}", *atLeast);
  if (below) upper = fmt::format(" below {}", *below);
  if (atMost) upper = fmt::format(" at most {}", *atMost);
  return lower + (!lower.empty() && !upper.empty() ? " and" : "") + upper;
}

}  // namespace burnish::inline schema
