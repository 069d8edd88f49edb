#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/csv.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {

/// Numbers of instants as CSV: the run where one has a name, the time, and the numbers with their units. columns: have `name`,
/// `value(numbers)` and `unit`. rows: have `run`, `time` and `numbers`. unitText: of a unit.
template <class Columns, class Row, class UnitText>
std::string numbersCsv(const Columns& columns, const std::vector<Row>& rows, const UnitText& unitText) {
  const bool named = std::ranges::any_of(rows, [](const Row& row) { return !row.run.empty(); });
  std::vector<std::string> titles{"time"};
  if (named) titles.insert(titles.begin(), "run");
  for (const auto& column : columns) titles.push_back(labelled(column.name, unitText(column.unit)));
  std::string text = csvRow(titles) + "\n";
  for (const Row& row : rows) {
    std::vector<std::string> cells{fmt::format("{}", row.time)};
    if (named) cells.insert(cells.begin(), row.run);
    for (const auto& column : columns) cells.push_back(fmt::format("{}", column.value(row.numbers)));
    text += csvRow(cells) + "\n";
  }
  return text;
}

/// The names of columns.
template <class Columns>
std::vector<std::string> namesOfColumns(const Columns& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.emplace_back(column.name);
  return names;
}

}  // namespace burnish
