#pragma once
#include <vector>

#include "engine/core/formula.h"
#include "engine/results/history.h"
#include "postproc/scene/scene_checks.h"

namespace burnish {

/// The value of a check's quantity in a history: in its last row, in the row of the check's time, or the
/// largest or smallest of all rows. The formula may name definitions without coordinates. Throws `Error` for
/// columns that do not exist, values that are not finite, and a time that has no row, with the nearest one.
double quantityOf(const CheckSpec& check, const HistoryTable& history,
                  const std::vector<DefinitionSpec>& definitions);

}  // namespace burnish
