#pragma once
#include <filesystem>

#include "postproc/compare/data/data_series.h"

namespace burnish {

/// The frames of a result: mesh, fields of control-point coefficients, contact, tools and quadrature points.
/// path: the directory of a run or the result file in it. Throws `Error` for what is no result, or has no
/// frames yet.
DataSeries frameSeries(const std::filesystem::path& path);

/// The rows of the `history.csv` of a run's directory, or of that of `result.h5` in it; no rows if there is
/// none.
DataSeries historySeries(const std::filesystem::path& path);

}  // namespace burnish
