#include "postproc/draw/contour_series.h"

#include <algorithm>
#include <limits>

#include "postproc/draw/color_range.h"

namespace burnish {

std::array<double, 2> commonRange(const ResultReader& result, const std::vector<int>& frames,
                                  const ContourOptions& options) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> range{infinity, -infinity};
  const int subdivision = options.subdivision.value_or(result.model().subdivision);
  for (const int k : frames) {
    const auto [low, high] =
        fieldRange(result.model(), result.frame(k), options.field, subdivision, options.clip);
    range = {std::min(range[0], low), std::max(range[1], high)};
  }
  return widened(range);
}

Eigen::AlignedBox2d commonWindow(const ResultReader& result, const std::vector<int>& frames,
                                 const ContourOptions& options) {
  Eigen::AlignedBox2d window;
  for (const int k : frames) window.extend(contentOf(result.model(), result.frame(k), options));
  return window;
}

}  // namespace burnish
