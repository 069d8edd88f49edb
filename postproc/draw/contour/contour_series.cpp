#include "postproc/draw/contour/contour_series.h"

#include <vtkImageData.h>

#include <algorithm>
#include <future>
#include <limits>

#include "engine/core/interruption.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/page/png_file.h"

namespace burnish {
std::array<double, 2> shownRange(const ModelRecord& model, const FrameRecord& frame,
                                 const ContourOptions& options) {
  const int subdivision = options.subdivision.value_or(model.subdivision);
  if (options.mirror.empty()) return fieldRange(model, frame, options.field, subdivision, options.clip);
  // Components of a field may have another sign in a mirror.
  const ModelFrame whole = mirrored(model, frame, options.mirror);
  return fieldRange(whole.model, whole.frame, options.field, subdivision, options.clip);
}

std::array<double, 2> commonRange(const ResultReader& result, const std::vector<int>& frames,
                                  const ContourOptions& options) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> range{infinity, -infinity};
  for (const int k : frames) {
    throwIfInterrupted();
    const auto [low, high] = shownRange(result.model(), result.frame(k), options);
    range = {std::min(range[0], low), std::max(range[1], high)};
  }
  return widened(range);
}

Eigen::AlignedBox2d commonWindow(const ResultReader& result, const std::vector<int>& frames,
                                 const ContourOptions& options) {
  Eigen::AlignedBox2d window;
  for (const int k : frames) {
    throwIfInterrupted();
    window.extend(contentOf(result.model(), result.frame(k), options));
  }
  return window;
}

void drawSeries(const ResultReader& result, const std::vector<int>& frames, const ContourOptions& options,
                const std::vector<std::filesystem::path>& names) {
  vtkSmartPointer<vtkImageData> picture;  // outlives its writing
  std::future<void> writing;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const ContourImage next = contourImage(result.model(), result.frame(frames[k]), options);
    if (writing.valid()) writing.get();
    picture = next.picture;
    writing = std::async(std::launch::async, [&picture, &name = names[k]] { writePng(*picture, name); });
  }
  if (writing.valid()) writing.get();
}

}  // namespace burnish
