#pragma once
#include <filesystem>
#include <vector>

/// What stands in a directory of results without being of `burnish` is never overwritten.
namespace burnish {

/// Whether a run has written to the directory before. The model file goes first when a run begins anew, and
/// says itself if it is not a run's.
bool isOfARun(const std::filesystem::path& directory);

/// Files of a series for ParaView in the directory, whoever made it: `frames.pvd` and `frames.py`, there or
/// not, and the VTU and VTP files in `frames/`.
std::vector<std::filesystem::path> seriesFiles(const std::filesystem::path& directory);

/// Whether `frames.pvd` in the directory is a collection of files in `frames/`.
bool hasSeries(const std::filesystem::path& directory);

/// Throws `Error` naming the first of the files that is there, a symbolic link included.
void requireAbsent(const std::vector<std::filesystem::path>& files);

}  // namespace burnish
