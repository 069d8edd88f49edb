#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/comparison.h"

namespace burnish {

/// Writes DIRECTORY/index.html, one page that shows every pair, failures first, and needs nothing else: no
/// network, no other file. `acceptCommand` is the command line that the page completes with the names of the
/// pictures that are chosen there. Returns the page's name. Throws `Error` if it cannot be written.
std::filesystem::path writeReport(const std::vector<Comparison>& comparisons, const PictureRule& rule,
                                  const std::string& acceptCommand, const std::filesystem::path& directory);

}  // namespace burnish
