#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace burnish {

/// What can be compared: pictures, which `comparePictures` knows, and data.
enum class ComparedKind { Pictures, Result, VtkFile, VtkCollection, Directory };

/// What two paths are, by directory and ending: a directory with `result.h5` or a `.h5` file is a result; a
/// directory below which there are runs, or other programs' files and no pictures, is one of data; every other
/// directory, and what has another ending, is of pictures. Two directories of which one is a run and the other
/// holds none are of pictures, and a path that is not there, or a directory with nothing to compare in it, is
/// of the kind of the other one. Throws `Error` for two kinds.
ComparedKind kindOf(const std::filesystem::path& actual, const std::filesystem::path& baseline);

/// Two that are compared.
struct DataPair {
  std::string name;   ///< below two directories; empty for the two that were given
  ComparedKind kind;  ///< of a result or a file
  std::filesystem::path actual, baseline;
};

/// The two, or those below two directories, sorted by name; one of them may be missing. Throws `Error` for a
/// directory that cannot be read.
std::vector<DataPair> dataPairs(ComparedKind kind, const std::filesystem::path& actual,
                                const std::filesystem::path& baseline);

}  // namespace burnish
