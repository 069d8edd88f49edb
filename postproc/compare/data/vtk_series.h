#pragma once
#include <filesystem>

#include "postproc/compare/data/data_series.h"

namespace burnish {

/// One VTK file (`.vtu`, `.pvtu` or `.vtp`): points, cells, and the numbers at them, of every
/// piece. A unit in brackets is taken off an array's name. Throws `Error` naming the file if it is not there, foreign or damaged.
DataSeries vtkFileSeries(const std::filesystem::path& file);

/// The files of a ParaView collection (`.pvd`) by their times; those of one time are parts.
DataSeries vtkCollectionSeries(const std::filesystem::path& file);

}  // namespace burnish
