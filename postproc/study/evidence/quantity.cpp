#include "postproc/study/evidence/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/same_time.h"
#include "postproc/study/evidence/expression.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

/// Whether a formula has a name in it, not only as a part of another one.
bool mentions(const std::string& formula, const std::string& name) {
  const auto goesOn = [&](std::size_t k) {
    return k < formula.size() && (std::isalnum(static_cast<unsigned char>(formula[k])) != 0 ||
                                  formula[k] == '_' || formula[k] == '.');
  };
  for (std::size_t k = formula.find(name); k != std::string::npos; k = formula.find(name, k + 1))
    if ((k == 0 || !goesOn(k - 1)) && !goesOn(k + name.size())) return true;
  return false;
}

/// A definition as a column, which the formulas of histories know.
void addColumn(HistoryTable& history, const DefinitionSpec& definition,
               const std::vector<DefinitionSpec>& definitions) {
  if (std::find(history.columns.begin(), history.columns.end(), definition.name) != history.columns.end())
    throw Error(fmt::format("{}: both a definition and a column have the name {}", history.path.string(),
                            definition.name));
  const Formula formula(definition.formula, definitions);
  for (const char* coordinate : {"X", "Y", "Z"})
    if (formula.dependsOn(coordinate))
      throw Error(fmt::format("the definition {} depends on {}; allowed in a quantity: numbers and the time",
                              definition.name, coordinate));
  std::vector<double> values;
  for (const double t : history.column("time")) values.push_back(formula(Eigen::Vector3d::Zero(), t));
  history.columns.push_back(definition.name);
  history.values.push_back(std::move(values));
}

std::size_t rowAt(double time, const std::vector<double>& times) {
  const auto nearest = std::min_element(times.begin(), times.end(), [=](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  if (isSameTime(*nearest, time)) return static_cast<std::size_t>(nearest - times.begin());
  throw Error(
      fmt::format("there is no row at t = {}; the nearest one is at t = {}", time, plainTime(*nearest)));
}

/// The rows that the number is made of.
Series countedRows(const CheckedQuantity& quantity, const Series& all) {
  const auto only = [&](std::size_t row) { return Series{{all.x[row]}, {all.y[row]}}; };
  if (quantity.time) return only(rowAt(*quantity.time, all.x));
  return quantity.reduction == RowReduction::Last ? only(all.x.size() - 1) : all;
}

}  // namespace

HistoryTable withDefinitions(HistoryTable table, const std::string& formula,
                             const std::vector<DefinitionSpec>& definitions) {
  for (const DefinitionSpec& definition : definitions)
    if (mentions(formula, definition.name)) addColumn(table, definition, definitions);
  return table;
}

double valueOf(const CheckedQuantity& quantity, const HistoryTable& history,
               const std::vector<DefinitionSpec>& definitions) {
  if (history.numRows() == 0) throw Error(fmt::format("{} has no rows", history.path.string()));
  const std::vector<double> values =
      evaluate(withDefinitions(history, quantity.formula, definitions), quantity.formula);
  const Series rows = countedRows(quantity, {history.column("time"), values});
  for (std::size_t k = 0; k < rows.y.size(); ++k)
    if (!std::isfinite(rows.y[k]))
      throw Error(rows.y.size() == 1 ? "the quantity is not finite"
                                     : fmt::format("the quantity is not finite at t = {}", rows.x[k]));
  return reduced(rows, static_cast<Reduction>(quantity.reduction)).value();
}

}  // namespace burnish
