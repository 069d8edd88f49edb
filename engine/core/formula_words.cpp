#include "engine/core/formula_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/quoted.h"

namespace burnish::inline core {
namespace {

constexpr std::array kConstants{std::pair{"pi", std::numbers::pi}, std::pair{"e", std::numbers::e}};

bool isWordPart(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The first word in front of a bracket that is no function; empty if there is none.
std::string unknownFunction(const std::string& formula) {
  const auto functions = formulaFunctions();
  for (std::size_t bracket = formula.find('('); bracket != std::string::npos;
       bracket = formula.find('(', bracket + 1)) {
    std::size_t end = bracket;
    while (end > 0 && formula[end - 1] == ' ') --end;
    std::size_t begin = end;
    while (begin > 0 && isWordPart(formula[begin - 1])) --begin;
    const std::string word = formula.substr(begin, end - begin);
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word.front())) != 0) continue;
    if (std::find(functions.begin(), functions.end(), word) == functions.end()) return word;
  }
  return {};
}

}  // namespace

std::vector<std::string> formulaFunctions() {
  std::vector<std::string> names;
  const mu::Parser parser;
  for (const auto& [name, unused] : parser.GetFunDef()) names.push_back(name);
  return names;
}

std::string formulaWords() {
  return fmt::format("functions are {}; constants are pi and e", fmt::join(formulaFunctions(), ", "));
}

void defineConstants(mu::Parser& parser, const std::vector<std::string>& names) {
  for (const auto& [name, value] : kConstants)
    if (std::find(names.begin(), names.end(), name) == names.end()) parser.DefineConst(name, value);
}

std::string formulaProblem(const std::string& formula, const mu::ParserError& problem) {
  const std::string word = unknownFunction(formula);
  if (word.empty()) {
    std::string text = shortened(problem.GetMsg());
    while (text.ends_with('.')) text.pop_back();
    return text;
  }
  return fmt::format("{} is no function{}; {}", quoted(word), orNearest(word, formulaFunctions()),
                     formulaWords());
}

std::string orNearest(const std::string& word, const std::vector<std::string>& names) {
  const auto best = nearest(word, names);
  return best ? fmt::format(" (did you mean {}?)", *best) : "";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 40;
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{}, ... ({} in all)", fmt::join(names.begin(), names.begin() + kMost, ", "),
                     names.size());
}

}  // namespace burnish::inline core
