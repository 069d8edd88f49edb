#include "postproc/draw/chart/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/core/atomic_file.h"
#include "engine/core/csv.h"
#include "engine/core/drawable_range.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "postproc/draw/chart/chart_layout.h"
#include "postproc/draw/chart/chart_output.h"
#include "postproc/draw/chart/chart_sketch.h"
#include "postproc/draw/page/picture_size.h"

namespace burnish {
namespace {

std::string curveName(const Chart& chart, std::size_t number) {
  const std::string& label = chart.curves[number].label;
  return label.empty() ? fmt::format("curve {}", number + 1) : label;
}

void checkSize(const std::array<int, 2>& size) {
  if (!isPictureSize(size))
    throw Error(
        fmt::format("chart: found a size of {} x {}; expected {}", size[0], size[1], pictureSizeWords()));
}

void checkRange(const ChartAxis& axis, const char* name) {
  if (!axis.range) return;
  const auto [low, high] = *axis.range;
  if (!isDrawableRange(*axis.range))
    throw Error(fmt::format("chart: found the range {}, {} of the {} axis; expected {}", low, high, name,
                            kDrawableRangeWords));
  if (axis.logarithmic && low < kSmallestDrawnSpan)
    throw Error(fmt::format("chart: found the range {}, {} of the logarithmic {} axis; both must be positive",
                            low, high, name));
}

/// Only points that are drawn count.
void checkPoints(const Chart& chart, std::size_t number) {
  const ChartCurve& curve = chart.curves[number];
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!std::isfinite(curve.x[k]) || !std::isfinite(curve.y[k])) continue;
    const bool largeX = std::abs(curve.x[k]) > kLargestDrawn;
    if (largeX || std::abs(curve.y[k]) > kLargestDrawn)
      throw Error(fmt::format("chart: point {} of \"{}\" has {} = {}; a chart shows magnitudes up to {}",
                              k + 1, curveName(chart, number), largeX ? "x" : "y",
                              largeX ? curve.x[k] : curve.y[k], kLargestDrawn));
    const bool inX = chart.x.logarithmic && curve.x[k] < kSmallestDrawnSpan;
    const ChartAxis& y = curve.onRight ? chart.y2 : chart.y;
    if (inX || (y.logarithmic && curve.y[k] < kSmallestDrawnSpan))
      throw Error(fmt::format(
          "log: point {} of \"{}\" has {} = {}; a logarithmic axis shows positive values only, from {} on",
          k + 1, curveName(chart, number), inX ? "x" : "y", inX ? curve.x[k] : curve.y[k],
          kSmallestDrawnSpan));
  }
}

void check(const Chart& chart) {
  checkSize(chart.size);
  checkRange(chart.x, "x");
  checkRange(chart.y, "y");
  checkRange(chart.y2, "y2");
  bool empty = true;
  for (std::size_t number = 0; number < chart.curves.size(); ++number) {
    const ChartCurve& curve = chart.curves[number];
    if (curve.x.size() != curve.y.size())
      throw Error(fmt::format("chart: \"{}\" has {} values of x and {} of y", curveName(chart, number),
                              curve.x.size(), curve.y.size()));
    checkPoints(chart, number);
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      empty = empty && !(std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]));
  }
  if (empty) throw Error("chart: there is no point to draw; all curves are empty or not finite");
}

ChartSketch checkedSketch(const Chart& chart) {
  throwIfInterrupted();
  check(chart);
  return sketchChart(layOutChart(chart), chart.size, chart.theme);
}

}  // namespace

bool Chart::hasRightAxis() const {
  return std::any_of(curves.begin(), curves.end(), [](const ChartCurve& curve) { return curve.onRight; });
}

void drawChart(const Chart& chart, const std::filesystem::path& file) {
  writeSketch(checkedSketch(chart), file);
}

PrintPage chartPage(const Chart& chart) {
  return pageOf(checkedSketch(chart));
}

std::string chartDataText(const Chart& chart) {
  std::vector<std::string> titles;
  std::size_t rows = 0;
  for (std::size_t number = 0; number < chart.curves.size(); ++number) {
    const std::string name = curveName(chart, number), axis = chart.curves[number].onRight ? "2" : "";
    for (const char* direction : {" x", " y"}) titles.push_back(name + direction + axis);
    rows = std::max(rows, chart.curves[number].x.size());
  }
  std::string text = csvRow(titles) + "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const ChartCurve& curve : chart.curves)
      for (const std::vector<double>* values : {&curve.x, &curve.y})
        cells.push_back(row < curve.x.size() ? fmt::format("{}", (*values)[row]) : "");
    text += csvRow(cells) + "\n";
  }
  return text;
}

void writeChartData(const Chart& chart, const std::filesystem::path& csv) {
  const std::string text = chartDataText(chart);
  writeFileAtomically(csv, std::as_bytes(std::span(text)));
}

}  // namespace burnish
