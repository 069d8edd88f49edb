#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/analysis/model.h"
#include "engine/analysis/state_quantities.h"

namespace burnish {

/// What a row of the history is made of.
struct HistoryRow {
  const StateQuantities& state;
  int step = 0;
  int newtonIterations = 0;  ///< of this step, failed attempts included
};

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

}  // namespace burnish
