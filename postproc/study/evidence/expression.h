#pragma once
#include <string>
#include <vector>

#include "engine/results/history.h"

namespace burnish {

/// A column of a history, or a formula in its columns for every row, such as "cylinder.fy/1000" or
/// "time >= 1 && time < 2" (1 where it is true, 0 elsewhere). One value per row, which is not finite where
/// the formula has none. Throws `Error` that names the history, the formula, the place in it and the columns.
std::vector<double> evaluate(const HistoryTable& history, const std::string& expression);

}  // namespace burnish
