#pragma once
#include <filesystem>
#include <vector>

namespace burnish {

/// Throws `Error` for no or missing pictures and a rate outside (0, 240].
void checkFrames(const std::vector<std::filesystem::path>& frames, double framesPerSecond);

}  // namespace burnish
