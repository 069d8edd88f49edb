#pragma once
#include <json/value.h>

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/comparison.h"

namespace burnish {

/// What a page of pairs shows.
struct ReportPage {
  std::string title, what;    ///< "Image regression", "pictures"
  std::string rule;           ///< by which they were compared: a sentence
  std::string acceptCommand;  ///< which the page completes with the names of the pairs that are chosen there

  /// Objects: `name`, `verdict`, `message`, `acceptable`, `updated` (whether an update makes the actual one the baseline), the pictures `baseline`, `actual` and `difference` as
  /// addresses (`pngUri`) or null, and whether the first two are `comparable`, being of one size.
  std::vector<Json::Value> pairs;

  bool isUpdated = false;  ///< the update has been done
};

/// Throws `Error` if DIRECTORY/index.html is there and is no page of pairs: it is not overwritten.
void requireNoOtherPage(const std::filesystem::path& directory);

/// Writes DIRECTORY/index.html, one page that shows every pair, failures first, and needs nothing else: no
/// network, no other file. Returns its name. Throws `Error` if it cannot be written.
std::filesystem::path writeReport(const ReportPage& page, const std::filesystem::path& directory);

/// The page of pictures as they are now. updates: those that are acceptable become the baselines.
ReportPage picturePage(const std::vector<Comparison>& comparisons, const PictureRule& rule,
                       const std::string& acceptCommand, bool updates);

}  // namespace burnish
