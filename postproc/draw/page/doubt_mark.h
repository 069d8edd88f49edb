#pragma once
#include <filesystem>
#include <string>

namespace burnish {

/// What stands in a corner of a picture of results that the run itself doubts.
inline constexpr const char* kDoubtMark = "⚠ doubtful results: see summary.yaml";

/// The mark if the summary of a run names a doubt; else, and without a summary that can be read, nothing.
std::string doubtMarkOf(const std::filesystem::path& runDirectory);

}  // namespace burnish
