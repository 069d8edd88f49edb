#include "cli/watch/text_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace burnish {
namespace {

constexpr std::array kBlocks{" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr int kEighths = 8;

using Points = std::vector<std::pair<double, double>>;

Points pointsOf(const TextChart& chart) {
  Points points;
  for (std::size_t k = 0; k < std::min(chart.x.size(), chart.y.size()); ++k)
    if (std::isfinite(chart.x[k]) && std::isfinite(chart.y[k])) points.emplace_back(chart.x[k], chart.y[k]);
  return points;
}

/// Between the points, linear; nothing outside of them.
std::optional<double> valueAt(const Points& points, double x) {
  if (x < points.front().first || x > points.back().first) return std::nullopt;
  const auto right = std::ranges::lower_bound(points, x, {}, &std::pair<double, double>::first);
  if (right == points.begin()) return right->second;
  const auto& [x0, y0] = *(right - 1);
  const auto& [x1, y1] = *right;
  return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
}

}  // namespace

std::vector<std::string> chartLines(const TextChart& chart) {
  const Points points = pointsOf(chart);
  if (points.size() < 2 || chart.columns < 2) return {};
  const auto [least, most] = std::ranges::minmax_element(points, {}, &std::pair<double, double>::second);
  const double low = least->second, high = most->second;
  std::vector<std::string> lines(static_cast<std::size_t>(chart.rows));
  for (int column = 0; column < chart.columns; ++column) {
    const double x = chart.begin + (chart.end - chart.begin) * column / (chart.columns - 1);
    const auto value = valueAt(points, x);
    // The smallest value has the lowest eighth, so that it can be told from none.
    const double share = high > low && value ? (*value - low) / (high - low) : 0.0;
    const long eighths = value ? 1 + std::lround(share * (kEighths * chart.rows - 1)) : 0;
    for (int row = 0; row < chart.rows; ++row) {
      const long filled =
          std::clamp(eighths - static_cast<long>(kEighths) * (chart.rows - 1 - row), 0l, long{kEighths});
      lines[static_cast<std::size_t>(row)] += chart.blocks ? kBlocks[static_cast<std::size_t>(filled)]
                                              : 2 * filled >= kEighths || (filled > 0 && eighths < kEighths)
                                                  ? "#"
                                                  : " ";
    }
  }
  lines.front() += fmt::format("  {:.4g}", high);
  lines.back() += fmt::format("  {:.4g}", low);
  for (std::string& line : lines) line.erase(line.find_last_not_of(' ') + 1);
  return lines;
}

}  // namespace burnish
