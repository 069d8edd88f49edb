#pragma once
#include <filesystem>
#include <string>

#include "cli/watch/followed_run.h"

namespace burnish {

/// Writes a page that shows where a run stands, with its newest picture and the history of a column, and loads itself again every two
/// seconds until the run has ended. Throws `Error` if it cannot be written.
void writeWatchPage(const std::filesystem::path& run, const RunState& state, const std::string& column,
                    const std::filesystem::path& page);

}  // namespace burnish
