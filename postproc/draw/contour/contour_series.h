#pragma once
#include <filesystem>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"

/// Pictures of several frames, and what they share so that they can be compared.
namespace burnish {

/// The range of colours of one frame that is drawn like this.
std::array<double, 2> shownRange(const ModelRecord& model, const FrameRecord& frame,
                                 const ContourOptions& options);

/// A range of colours for these frames: from the smallest to the largest value that one of them shows, or
/// that `options.clip` leaves of it. Throws `Error` as `drawContour` does.
std::array<double, 2> commonRange(const ResultReader& result, const std::vector<int>& frames,
                                  const ContourOptions& options);

/// The window in which all of these frames are seen whole.
Eigen::AlignedBox2d commonWindow(const ResultReader& result, const std::vector<int>& frames,
                                 const ContourOptions& options);

/// Draws these frames as `drawContour` does, each into its file, one after the other. A picture is written
/// while the next one is drawn. names: one per frame. Throws `Error` as `drawContour` does.
void drawSeries(const ResultReader& result, const std::vector<int>& frames, const ContourOptions& options,
                const std::vector<std::filesystem::path>& names);

}  // namespace burnish
