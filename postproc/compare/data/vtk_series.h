#pragma once
#include <filesystem>

#include "postproc/compare/data/data_series.h"

namespace burnish {

/// A file of another program: points, cells, and the numbers at them, of every block, at its times if it has
/// any. A unit in brackets is taken off an array's name. Throws `Error` as `ForeignFile` does.
DataSeries foreignSeries(const std::filesystem::path& file);

}  // namespace burnish
