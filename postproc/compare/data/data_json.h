#pragma once
#include <string>
#include <vector>

#include "postproc/compare/data/compare_data.h"

namespace burnish {

/// A list of one object per field, in as many lines: `result` (null unless it is one of several), `name`, `verdict`, `message`, `allowed`, `differing`,
/// `compared` and of the worst place `time`, `place`, `number`, `owner`, `component`, `position`, `actual`,
/// `baseline`, `difference`, which are null where there is none. Numbers that are not finite are texts.
std::string fieldsText(const std::vector<ResultComparison>& comparisons);

}  // namespace burnish
