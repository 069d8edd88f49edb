#pragma once
#include <filesystem>

#include "engine/results/run_account.h"

namespace burnish::inline results {

/// Throws `Error` if the file cannot be written.
void writeSummary(const std::filesystem::path& directory, const RunAccount& account);

/// Throws `Error` if there is no summary in the directory or it is damaged. Entries that this version does
/// not know are passed over.
RunAccount readSummary(const std::filesystem::path& directory);

/// A run removes the summary of an earlier one before it starts, so a summary means a run that has ended.
void removeSummary(const std::filesystem::path& directory);

}  // namespace burnish::inline results
