#include "postproc/study/study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/nearest.h"

namespace burnish {
namespace {

/// Whether the pattern is the name when every * stands for some part of it.
bool isMatch(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {  // the last * takes one character more
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

[[noreturn]] void rejectPattern(const std::string& pattern, const std::vector<StudyRun>& runs) {
  constexpr std::size_t kShown = 12;
  std::vector<std::string> names;
  for (const StudyRun& run : runs) names.push_back(run.name);
  const std::span first(names.begin(), std::min(kShown, names.size()));
  throw Error(fmt::format("found {}, which names no run; the runs are {}{}.{}", pattern,
                          fmt::join(first, ", "), names.size() > kShown ? ", ..." : "",
                          didYouMean(pattern, names)));
}

[[noreturn]] void rejectParameter(const std::string& text, const std::string& name,
                                  const std::map<std::string, std::string>& parameters) {
  std::vector<std::string> names;
  for (const auto& entry : parameters) names.push_back(entry.first);
  throw Error(fmt::format("found \"{}\", where {{{}}} stands for nothing; allowed in braces: {}.{}", text,
                          name, names.empty() ? "nothing here" : fmt::format("{}", fmt::join(names, ", ")),
                          didYouMean(name, names)));
}

}  // namespace

std::vector<const StudyRun*> Study::matching(const std::vector<std::string>& patterns) const {
  std::vector<const StudyRun*> matches;
  for (const std::string& pattern : patterns) {
    bool found = false;
    for (const StudyRun& run : runs) {
      if (!isMatch(pattern, run.name)) continue;
      found = true;
      if (std::find(matches.begin(), matches.end(), &run) == matches.end()) matches.push_back(&run);
    }
    if (!found) rejectPattern(pattern, runs);
  }
  return matches;
}

ClaimExpectation ClaimSpec::expectation() const {
  switch (expect) {
    case Expect::Increasing:
      return ExpectedTrend{ExpectedTrend::Direction::Increasing};
    case Expect::Equal:
      return ExpectedSameness{within.value()};
    case Expect::Different:
      return ExpectedDifference{within.value()};
    case Expect::Between:
      break;
  }
  const auto number = [](double bound) { return FormulaText{fmt::format("{}", bound)}; };
  return ExpectedRange{number(range.value()[0]), number(range.value()[1])};
}

std::string fillIn(const std::string& text, const std::map<std::string, std::string>& parameters) {
  constexpr const char* nameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::string filled;
  std::size_t at = 0;
  while (true) {
    const std::size_t open = std::min(text.find('{', at), text.size());
    filled += text.substr(at, open - at);
    if (open == text.size()) return filled;
    const std::size_t close = std::min(text.find_first_not_of(nameCharacters, open + 1), text.size());
    const std::string name = text.substr(open + 1, close - open - 1);
    if (close == text.size()) throw Error(fmt::format("found \"{}\": a brace is not closed", text));
    if (name.empty() || text[close] != '}') {  // not around a name: YAML, as in {until: 1, count: 5}
      filled += '{';
      at = open + 1;
      continue;
    }
    const auto parameter = parameters.find(name);
    if (parameter == parameters.end()) rejectParameter(text, name, parameters);
    filled += parameter->second;
    at = close + 1;
  }
}

}  // namespace burnish
