#pragma once
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/contour.h"

/// What the pictures of several frames share so that they can be compared.
namespace burnish {

/// A range of colours for these frames: from the smallest to the largest value that one of them shows, or
/// that `options.clip` leaves of it. Throws `Error` as `drawContour` does.
std::array<double, 2> commonRange(const ResultReader& result, const std::vector<int>& frames,
                                  const ContourOptions& options);

/// The window in which all of these frames are seen whole.
Eigen::AlignedBox2d commonWindow(const ResultReader& result, const std::vector<int>& frames,
                                 const ContourOptions& options);

}  // namespace burnish
