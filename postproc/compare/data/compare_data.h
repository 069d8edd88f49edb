#pragma once
#include <filesystem>
#include <vector>

#include "postproc/compare/data/data_comparison.h"

namespace burnish {

/// What can be compared: pictures, which `comparePictures` knows, and data.
enum class ComparedKind { Pictures, Result, VtkFile, VtkCollection };

/// What two paths are, by directory and ending: a directory with `result.h5` or a `.h5` file is a result;
/// every other directory, and what has another ending, is of pictures. Two directories of which one is none of a
/// run are of pictures, and a path that is not there is of the kind of the other one. Throws `Error` for two kinds.
ComparedKind kindOf(const std::filesystem::path& actual, const std::filesystem::path& baseline);

/// Compares two of a kind that is not pictures. Throws `Error` for what cannot be read, for patterns of the
/// rule that match nothing, and if they leave no field.
std::vector<FieldComparison> compareData(ComparedKind kind, const std::filesystem::path& actual,
                                         const std::filesystem::path& baseline, const DataRule& rule);

}  // namespace burnish
