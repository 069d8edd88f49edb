#include "engine/core/formula.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/core/definitions.h"
#include "engine/core/error.h"
#include "engine/core/formula_words.h"
#include "engine/core/quoted.h"

namespace burnish::inline core {

void requireSingleValue(const std::string& formula) {
  const auto at = [&](std::size_t k) { return k < formula.size() ? formula[k] : ' '; };
  int depth = 0;
  for (std::size_t k = 0; k < formula.size(); ++k) {
    depth += formula[k] == '(' ? 1 : formula[k] == ')' ? -1 : 0;
    if (formula[k] == ',' && depth == 0)
      throw Error(fmt::format("the formula {} has a comma outside of a function; write numbers with a point",
                              quoted(formula)));
    const bool comparison =
        at(k + 1) == '=' || (k > 0 && std::string("=<>!").find(formula[k - 1]) != std::string::npos);
    if (formula[k] == '=' && !comparison)
      throw Error(fmt::format("the formula {} assigns a value; write == to compare", quoted(formula)));
  }
}

namespace {

/// Where definitions stand, by name.
using DefinitionIndex = std::unordered_map<std::string_view, std::size_t>;

DefinitionIndex indexOf(const std::vector<DefinitionSpec>& definitions) {
  DefinitionIndex index;
  for (std::size_t k = 0; k < definitions.size(); ++k) index.try_emplace(definitions[k].name, k);
  return index;
}

/// Names that a formula needs from elsewhere, constants among them.
std::vector<std::string> namesIn(mu::Parser& probe, const std::string& text) {
  probe.SetExpr(text);
  std::vector<std::string> names;
  for (const auto& [name, unused] : probe.GetUsedVar()) names.push_back(name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isConstant(const std::string& name) {
  return name == "pi" || name == "e";
}

Error notUnderstood(const std::string& text, const mu::ParserError& problem) {
  return Error(
      fmt::format("the formula {} cannot be understood: {}", quoted(text), formulaProblem(text, problem)));
}

/// Places, in the definitions before `known`, of those that a formula names. Throws `Error` for names that
/// are nothing.
std::vector<std::size_t> neededDefinitions(const std::string& text, const std::vector<std::string>& names,
                                           const std::vector<std::string>& variables,
                                           const std::vector<DefinitionSpec>& definitions,
                                           const DefinitionIndex& index, std::size_t known) {
  std::vector<std::size_t> needed;
  for (const std::string& name : names) {
    if (contains(variables, name)) continue;
    const auto found = index.find(name);
    if (found != index.end() && found->second < known) {
      needed.push_back(found->second);
    } else if (std::isdigit(static_cast<unsigned char>(name.front())) !=
               0) {  // the parser gives it up as a name
      throw Error(
          fmt::format("the formula {} has the number {}, which does not fit into double precision, between "
                      "1e-308 and 1e308 in size",
                      quoted(text), shortened(name)));
    } else if (!isConstant(name)) {
      std::vector<std::string> allowed = variables;
      for (std::size_t k = 0; k < known; ++k) allowed.push_back(definitions[k].name);
      std::vector<std::string> candidates = allowed;
      candidates.insert(candidates.end(), {"pi", "e"});
      throw Error(fmt::format("the formula {} names {}, which is unknown here{}; known are {}; {}",
                              quoted(text), shortened(name), orNearest(name, candidates), listed(allowed),
                              formulaWords()));
    }
  }
  return needed;
}

}  // namespace

/// The formula itself comes last, after the definitions that it needs.
struct Formula::Parsers {
  struct Entry {
    std::string text;
    double value = 0.0;
    mu::Parser parser;
  };

  std::vector<std::string> variables;
  std::vector<double> point;  // values of the variables
  std::deque<Entry> entries;  // entries keep their addresses: parsers refer to values of earlier ones
  std::set<std::string> used;

  void addAll(const std::string& text, const std::vector<DefinitionSpec>& definitions);

 private:
  void add(const std::string& text, const std::vector<std::string>& names,
           const std::unordered_map<std::string, double*>& values);
};

/// values: of the definitions added so far.
void Formula::Parsers::add(const std::string& text, const std::vector<std::string>& names,
                           const std::unordered_map<std::string, double*>& values) {
  Entry& entry = entries.emplace_back();
  entry.text = text;
  try {
    for (std::size_t k = 0; k < variables.size(); ++k) entry.parser.DefineVar(variables[k], &point[k]);
    std::vector<std::string> taken = variables;
    for (const std::string& name : names) {
      if (contains(variables, name)) {
        used.insert(name);
      } else if (const auto value = values.find(name); value != values.end()) {
        entry.parser.DefineVar(name, value->second);
        taken.push_back(name);
      }
    }
    defineConstants(entry.parser, taken);
    entry.parser.SetExpr(text);
    entry.parser.Eval();
  } catch (const mu::ParserError& problem) {
    throw notUnderstood(text, problem);
  }
}

/// A formula and, before it, the definitions that it needs, these in their order.
void Formula::Parsers::addAll(const std::string& text, const std::vector<DefinitionSpec>& definitions) {
  const DefinitionIndex index = indexOf(definitions);
  mu::Parser probe;
  const auto namesOf = [&](const std::string& formula) {
    requireSingleValue(formula);
    try {
      return namesIn(probe, formula);
    } catch (const mu::ParserError& problem) {
      throw notUnderstood(formula, problem);
    }
  };
  const std::vector<std::string> own = namesOf(text);
  std::map<std::size_t, std::vector<std::string>> needed;  // names in the definitions, by place
  std::vector<std::size_t> open =
      neededDefinitions(text, own, variables, definitions, index, definitions.size());
  while (!open.empty()) {
    const std::size_t k = open.back();
    open.pop_back();
    const auto [added, isNew] = needed.try_emplace(k);
    if (!isNew) continue;
    const std::string& formula = definitions[k].formula.text;
    added->second = namesOf(formula);
    const auto more = neededDefinitions(formula, added->second, variables, definitions, index, k);
    open.insert(open.end(), more.begin(), more.end());
  }
  std::unordered_map<std::string, double*> values;
  for (const auto& [k, names] : needed) {
    add(definitions[k].formula.text, names, values);
    values[definitions[k].name] = &entries.back().value;
  }
  add(text, own, values);
}

Formula::Formula(const FormulaText& formula, const std::vector<DefinitionSpec>& definitions,
                 std::vector<std::string> variables)
    : parsers_(std::make_shared<Parsers>()) {
  parsers_->point.resize(variables.size());
  parsers_->variables = std::move(variables);
  parsers_->addAll(formula.text, definitions);
}

double Formula::operator()(const Eigen::Vector3d& X, double t) const {
  return at(std::array{X(0), X(1), X(2), t});
}

double Formula::at(std::span<const double> values) const {
  assert(values.size() == parsers_->point.size());
  std::copy(values.begin(), values.end(), parsers_->point.begin());
  for (auto& entry : parsers_->entries) entry.value = entry.parser.Eval();
  const auto& last = parsers_->entries.back();
  if (!std::isfinite(last.value)) {
    std::vector<std::string> place;
    for (std::size_t k = 0; k < values.size(); ++k)
      place.push_back(fmt::format("{} = {:.6g}", parsers_->variables[k], values[k]));
    throw FormulaError(
        fmt::format("the formula {} has no finite value at {}", quoted(last.text), fmt::join(place, ", ")));
  }
  return last.value;
}

bool Formula::dependsOn(const std::string& variable) const {
  return parsers_->used.contains(variable);
}

void requireFinite(const std::vector<Formula>& formulas, const Eigen::Matrix3Xd& points,
                   const std::vector<double>& times) {
  constexpr std::size_t kMostPairs = 1'000'000;
  for (const Formula& formula : formulas) {
    const bool inSpace = formula.dependsOn("X") || formula.dependsOn("Y") || formula.dependsOn("Z");
    const std::size_t numTimes =
        formula.dependsOn("t") ? times.size() : std::min<std::size_t>(1, times.size());
    const Eigen::Index numPoints = inSpace ? points.cols() : std::min<Eigen::Index>(1, points.cols());
    const std::size_t stride = 1 + numTimes * static_cast<std::size_t>(numPoints) / kMostPairs;
    const auto probe = [&](double t) {
      for (Eigen::Index k = 0; k < numPoints; ++k) static_cast<void>(formula(points.col(k), t));
    };
    for (std::size_t k = 0; k < numTimes; k += stride) probe(times[k]);
    if (numTimes > 1) probe(times.back());
  }
}

std::vector<DefinitionProblem> problemsOf(const std::vector<DefinitionSpec>& definitions,
                                          const std::vector<std::string>& variables) {
  const DefinitionIndex index = indexOf(definitions);
  std::vector<DefinitionProblem> problems;
  mu::Parser parser;
  double anything = 1.0;
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    const std::string& text = definitions[k].formula.text;
    try {
      requireSingleValue(text);
      parser.ClearVar();
      const auto names = namesIn(parser, text);
      static_cast<void>(neededDefinitions(text, names, variables, definitions, index, k));
      for (const std::string& name : names) parser.DefineVar(name, &anything);
      parser.Eval();
    } catch (const mu::ParserError& problem) {
      problems.push_back({k, notUnderstood(text, problem).what()});
    } catch (const Error& error) {
      problems.push_back({k, error.what()});
    }
  }
  return problems;
}

std::vector<Formula> makeFormulas(const std::vector<FormulaText>& texts,
                                  const std::vector<DefinitionSpec>& definitions) {
  std::vector<Formula> formulas;
  for (const FormulaText& text : texts) formulas.emplace_back(text, definitions);
  return formulas;
}

}  // namespace burnish::inline core
