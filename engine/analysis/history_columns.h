#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/analysis/state_quantities.h"

namespace burnish::inline analysis {

/// What a row of the history is made of.
struct HistoryRow {
  const StateQuantities& state;
  int step = 0;
  int newtonIterations = 0;  ///< of this step, failed attempts included
};

/// What the numbers of a column measure; plain ones have no unit.
enum class Measured { Number, Length, Degrees, Area, Force, Moment, Energy };

/// How a column is called in words, such as "Force on die in y".
struct ColumnMeaning {
  std::string words;
  Measured measured = Measured::Number;
};

/// What a column of a history means, all of whose columns are given; nothing for one that this file does not
/// know: measures and reactions, whose names the scene gives. tools: their names; what is known of them in a
/// history without its scene is that tools have displacements beside their forces.
std::optional<ColumnMeaning> columnMeaning(const std::string& column, const std::vector<std::string>& columns,
                                           const std::optional<std::vector<std::string>>& tools);

/// A column of the history, as documented in docs/results.md.
struct HistoryColumn {
  std::string name;
  std::function<double(const HistoryRow&)> value;
};

/// All columns of a scene's history, in their order. reactions, measures: names of these columns.
template <int Dim>
std::vector<HistoryColumn> historyColumns(const Scene& scene, const Model<Dim>& model,
                                          const std::vector<std::string>& reactions,
                                          const std::vector<std::string>& measures);

}  // namespace burnish::inline analysis
