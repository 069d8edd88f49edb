#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/results/model_io.h"
#include "engine/results/result.h"

namespace burnish::inline results {

/// The frame file as bytes.
std::vector<std::byte> frameImage(const FrameRecord& frame, const std::string& modelId);

/// Throws `Error` if the file is not a whole frame of this model.
FrameRecord readFrame(const std::filesystem::path& path, const StoredModel& model);

/// The time of a frame without its fields.
double readFrameTime(const std::filesystem::path& path, const StoredModel& model);

}  // namespace burnish::inline results
