#include "postproc/study/evidence/expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/formula_words.h"
#include "engine/core/nearest.h"

namespace burnish {
namespace {

constexpr const char* kNameCharacters = "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

bool isName(const std::string& text) {
  return text.find_first_not_of(kNameCharacters) == std::string::npos &&
         text.find_first_of("0123456789.") != 0;
}

Error mistake(const HistoryTable& history, const std::string& expression, std::size_t position,
              const std::string& what) {
  return Error(fmt::format("{}: formula \"{}\", character {}: {}", history.path.string(), expression,
                           position + 1, what));
}

/// The parser takes a single = for an assignment, which would be true everywhere.
void refuseAssignment(const HistoryTable& history, const std::string& expression) {
  for (std::size_t k = expression.find('='); k != std::string::npos; k = expression.find('=', k + 1)) {
    if (expression.substr(k).starts_with("=="))
      ++k;
    else if (k == 0 || std::string_view("<>!").find(expression[k - 1]) == std::string_view::npos)
      throw mistake(history, expression, k, "found a single =; write == to compare");
  }
}

Error parserMistake(const HistoryTable& history, const std::string& expression,
                    const mu::Parser::exception_type& problem) {
  const std::size_t position =
      std::min(static_cast<std::size_t>(std::max(0, problem.GetPos())), expression.size());
  if (problem.GetCode() != mu::ecUNASSIGNABLE_TOKEN)
    return mistake(history, expression, position, problem.GetMsg());
  return mistake(
      history, expression, position,
      fmt::format("there is no column \"{}\".{} The columns are {}", problem.GetToken(),
                  didYouMean(problem.GetToken(), history.columns), fmt::join(history.columns, ", ")));
}

}  // namespace

std::vector<double> evaluate(const HistoryTable& history, const std::string& expression) {
  const auto whole = std::find(history.columns.begin(), history.columns.end(), expression);
  if (whole != history.columns.end()) return history.column(expression);
  refuseAssignment(history, expression);

  std::vector<double> row(history.columns.size()), results;
  mu::Parser parser;
  parser.DefineNameChars(kNameCharacters);
  try {
    for (std::size_t c = 0; c < row.size(); ++c)
      if (isName(history.columns[c])) parser.DefineVar(history.columns[c], &row[c]);
    defineConstants(parser, history.columns);
    parser.SetExpr(expression);
    parser.Eval();  // finds mistakes in an empty history too
    if (parser.GetNumResults() != 1)
      throw mistake(history, expression, expression.find(','), "found a list; one value is expected");
    for (std::size_t r = 0; r < history.numRows(); ++r) {
      for (std::size_t c = 0; c < row.size(); ++c) row[c] = history.values[c][r];
      results.push_back(parser.Eval());
    }
  } catch (const mu::Parser::exception_type& problem) {
    throw parserMistake(history, expression, problem);
  }
  return results;
}

}  // namespace burnish
