#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"

namespace burnish {

/// Numbers of at most `most` (>= 2) of `count` frames: the first, the last and others evenly between.
std::vector<int> evenlyChosen(int count, int most);

/// A frame drawn as the bytes of a PNG.
std::string framePicture(const ResultReader& result, const FrameRecord& frame, const ContourOptions& options,
                         const std::filesystem::path& scratchDirectory);

}  // namespace burnish
