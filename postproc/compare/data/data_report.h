#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/data/compare_data.h"

namespace burnish {

/// Writes DIRECTORY/index.html as `writeReport` does of pictures: every field, those that differ first and with pictures of
/// both sides at the worst place, as `worstPictures` draws them. note: a sentence for the head of the page; may be
/// empty. Returns its name. Throws `Error` if it cannot be written.
std::filesystem::path writeDataReport(const std::vector<ResultComparison>& comparisons,
                                      const std::string& note, const std::filesystem::path& directory);

/// Draws the difference of the field that differs most of those that have such a picture, or else that field
/// itself, with a ring round the place; nothing if there is none. Throws `Error` if the file cannot be written.
void drawWorst(const std::vector<ResultComparison>& comparisons, const std::filesystem::path& png);

}  // namespace burnish
