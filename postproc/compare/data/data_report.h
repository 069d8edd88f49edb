#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/compare/data/compare_data.h"
#include "postproc/compare/report.h"

namespace burnish {

/// The page of every field as it is now, those that differ with pictures of both sides at the worst place, as
/// `WorstPictures` draws them. note: a sentence for the head of the page; may be empty. updates: what `becomesBaseline`
/// is said to have done so.
ReportPage dataPage(const std::vector<ResultComparison>& comparisons, const std::string& note, bool updates);

/// Draws the difference of the field that differs most of those that have such a picture, or else that field
/// itself, with a ring round the place; nothing if there is none. Returns what is drawn, "difference of stress,
/// component xx", which is empty then. Throws `Error` if the file cannot be written.
std::string drawWorst(const std::vector<ResultComparison>& comparisons, const std::filesystem::path& png);

}  // namespace burnish
