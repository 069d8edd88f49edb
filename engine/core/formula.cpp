#include "engine/core/formula.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "engine/core/error.h"

namespace burnish {

void requireSingleValue(const std::string& formula) {
  const auto at = [&](std::size_t k) { return k < formula.size() ? formula[k] : ' '; };
  int depth = 0;
  for (std::size_t k = 0; k < formula.size(); ++k) {
    depth += formula[k] == '(' ? 1 : formula[k] == ')' ? -1 : 0;
    if (formula[k] == ',' && depth == 0)
      throw Error(fmt::format(
          "the formula \"{}\" has a comma outside of a function; write numbers with a point", formula));
    const bool comparison =
        at(k + 1) == '=' || (k > 0 && std::string("=<>!").find(formula[k - 1]) != std::string::npos);
    if (formula[k] == '=' && !comparison)
      throw Error(fmt::format("the formula \"{}\" assigns a value; write == to compare", formula));
  }
}

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

  /// Adds a formula and, before it, the definitions that it needs. `known`: number of definitions it may use.
  Entry& add(const std::string& text, const std::vector<DefinitionSpec>& definitions, std::size_t known,
             std::map<std::string, double*>& values);
};

Formula::Parsers::Entry& Formula::Parsers::add(const std::string& text,
                                               const std::vector<DefinitionSpec>& definitions,
                                               std::size_t known, std::map<std::string, double*>& values) {
  requireSingleValue(text);
  try {
    mu::Parser probe;
    probe.SetExpr(text);
    std::vector<std::string> names;
    for (const auto& [name, unused] : probe.GetUsedVar()) names.push_back(name);
    for (const std::string& name : names) {
      if (std::find(variables.begin(), variables.end(), name) != variables.end()) {
        used.insert(name);
        continue;
      }
      if (values.contains(name)) continue;
      const auto limit = definitions.begin() + static_cast<std::ptrdiff_t>(known);
      const auto definition =
          std::find_if(definitions.begin(), limit, [&](const auto& d) { return d.name == name; });
      if (definition == limit) {
        std::vector<std::string> allowed = variables;
        for (auto d = definitions.begin(); d != limit; ++d) allowed.push_back(d->name);
        throw Error(fmt::format("the formula \"{}\" names {}, which is unknown here; known are {}", text,
                                name, fmt::join(allowed, ", ")));
      }
      values[name] = &add(definition->formula.text, definitions,
                          static_cast<std::size_t>(definition - definitions.begin()), values)
                          .value;
    }
    Entry& entry = entries.emplace_back();
    entry.text = text;
    for (std::size_t k = 0; k < variables.size(); ++k) entry.parser.DefineVar(variables[k], &point[k]);
    for (const auto& [name, value] : values) entry.parser.DefineVar(name, value);
    entry.parser.SetExpr(text);
    entry.parser.Eval();
    return entry;
  } catch (const mu::ParserError& problem) {
    throw Error(fmt::format("the formula \"{}\" cannot be understood: {}", text, problem.GetMsg()));
  }
}

Formula::Formula(const FormulaText& formula, const std::vector<DefinitionSpec>& definitions,
                 std::vector<std::string> variables)
    : parsers_(std::make_shared<Parsers>()) {
  parsers_->point.resize(variables.size());
  parsers_->variables = std::move(variables);
  std::map<std::string, double*> values;
  parsers_->add(formula.text, definitions, definitions.size(), values);
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
        fmt::format("the formula \"{}\" has no finite value at {}", last.text, fmt::join(place, ", ")));
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

std::vector<Formula> makeFormulas(const std::vector<FormulaText>& texts,
                                  const std::vector<DefinitionSpec>& definitions) {
  std::vector<Formula> formulas;
  for (const FormulaText& text : texts) formulas.emplace_back(text, definitions);
  return formulas;
}

}  // namespace burnish
