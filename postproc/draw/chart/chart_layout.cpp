#include "postproc/draw/chart/chart_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"

namespace burnish {
namespace {

// Parts of the text size.
constexpr double kMargin = 0.6;
constexpr double kTitleSize = 1.1;
constexpr double kHalfLine = 0.5;     ///< from the edge of a text to the middle of its capitals
constexpr double kBelowTitle = 1.0;   ///< from the middle of the title to what is under it
constexpr double kFactorRise = 0.75;  ///< from the plot to the middle of the factor of the y axis
constexpr double kXLabelDrop = 0.85;  ///< from the plot to the middle of the labels of the x axis
constexpr double kXTitleDrop = 1.4;   ///< from there to the middle of the title
constexpr double kYLabelGap = 0.4;    ///< from the labels of the y axis to the plot
constexpr double kYTitleGap = 1.1;    ///< from the middle of the title to the labels
constexpr double kLegendGap = 0.9;    ///< from the middle of the title of the x axis to the legend
constexpr double kRowOfTicks = 1.9;   ///< smallest distance of ticks on the y axis
constexpr double kBetweenLabels = 0.9;
constexpr double kSmallestText = 0.7;
constexpr double kWidestLabel = 0.55;  ///< of the legend, part of the picture's width
constexpr double kSmallestPlotWidth = 6.0, kSmallestPlotHeight = 4.0;

/// 7 points if the picture is printed 80 mm wide.
double chartTextSize(const std::array<int, 2>& size) {
  constexpr double smallest = 9.0;
  return std::max(smallest, std::round(std::min(0.031 * size[0], 0.0413 * size[1])));
}

bool within(double value, const ChartAxis& axis) {
  return !axis.range || (value >= (*axis.range)[0] && value <= (*axis.range)[1]);
}

/// Where the unit at the end of a title begins, as in "force [N]" and "force in N"; the end without one.
std::size_t unitIn(const std::string& title) {
  const std::size_t bracket = title.ends_with(']') ? title.rfind(" [") : std::string::npos;
  if (bracket != std::string::npos) return bracket;
  const std::size_t word = title.rfind(' ');
  const bool isIn = word != std::string::npos && title.substr(0, word).ends_with(" in");
  return isIn ? word - std::string(" in").size() : title.size();
}

/// Smallest and largest value along x, y and y2.
using DataRanges = std::array<std::array<double, 2>, 3>;

/// Of the points that can be seen, or of all.
DataRanges rangesOf(const Chart& chart, bool all) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  DataRanges ranges;
  ranges.fill({infinity, -infinity});
  const auto extend = [](std::array<double, 2>& range, double value) {
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (const ChartCurve& curve : chart.curves) {
    const ChartAxis& axis = curve.onRight ? chart.y2 : chart.y;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
      const double x = curve.x[k], y = curve.y[k];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      if (!all && (!within(x, chart.x) || !within(y, axis))) continue;
      extend(ranges[0], x);
      extend(ranges[curve.onRight ? 2 : 1], y);
    }
  }
  return ranges;
}

/// Of the points that can be seen, of all points if none can be, of nothing from 1 to 10.
DataRanges dataRanges(const Chart& chart) {
  DataRanges ranges = rangesOf(chart, false);
  const DataRanges all = rangesOf(chart, true);
  for (std::size_t d = 0; d < ranges.size(); ++d) {
    if (ranges[d][0] > ranges[d][1]) ranges[d] = all[d];
    if (ranges[d][0] > ranges[d][1]) ranges[d] = {1.0, 10.0};
  }
  return ranges;
}

/// Finds the plot's rectangle and the scales around the legend's part of the picture.
class Arrangement {
 public:
  Arrangement(const Chart& chart, ChartLayout& layout, double reservedBelow)
      : chart_(chart), layout_(layout), size_(layout.textSize), margin_(kMargin * size_) {
    placeVertically(reservedBelow);
    placeHorizontally();
    checkRoom();
    placeTitles();
    layout_.curves = plotCurves(chart, layout.plot, [this](double x, double y, bool onRight) {
      return layout_.pixel(x, y, onRight);
    });
  }

 private:
  void placeVertically(double reservedBelow) {
    // Whether a factor stands over the axis depends on the range alone, not on the room.
    makeVerticalScales([](const ChartScale&) { return true; });
    layout_.x = makeChartScale(chart_.x, ranges_[0], false, [](const ChartScale&) { return true; });
    const bool lineBelow = !chart_.x.title.empty() || !layout_.x.factor.empty();
    titleLine_ = margin_ + reservedBelow + kHalfLine * size_;
    layout_.xLabelsAt = titleLine_ + (lineBelow ? kXTitleDrop * size_ : 0.0);
    PixelRect& plot = layout_.plot;
    plot.y = std::round(layout_.xLabelsAt + kXLabelDrop * size_);
    double top = chart_.size[1] - margin_ - (kTitleSize * kHalfLine + kBelowTitle) * size_;
    if (chart_.title.empty()) top = chart_.size[1] - margin_ - kHalfLine * size_ / 2;
    if (!layout_.y.factor.empty() || (layout_.y2 && !layout_.y2->factor.empty()))
      top -= (kFactorRise + kHalfLine / 2) * size_;
    plot.height = std::round(top) - plot.y;
    makeVerticalScales([this](const ChartScale& scale) {
      for (std::size_t k = 1; k < scale.ticks.size(); ++k)
        if ((scale.share(scale.ticks[k]) - scale.share(scale.ticks[k - 1])) * layout_.plot.height <
            kRowOfTicks * size_)
          return false;
      return true;
    });
  }

  double labelWidth(const std::string& label) const {
    return textWidth({{label}}, {.size = size_, .font = chart_.theme.font});
  }

  double longest(const std::vector<std::string>& labels) const {
    double width = 0.0;
    for (const std::string& label : labels) width = std::max(width, labelWidth(label));
    return width;
  }

  void makeVerticalScales(const std::function<bool(const ChartScale&)>& fit) {
    layout_.y = makeChartScale(chart_.y, ranges_[1], true, fit);
    if (chart_.hasRightAxis()) layout_.y2 = makeChartScale(chart_.y2, ranges_[2], true, fit);
  }

  void placeHorizontally() {
    PixelRect& plot = layout_.plot;
    plot.x = std::round(margin_ + besidePlot(chart_.y, layout_.y));
    layout_.yLabelsEnd = plot.x - kYLabelGap * size_;
    double overhang = layout_.y2 ? besidePlot(chart_.y2, *layout_.y2) : 0.0;
    for (int pass = 0; pass < 2; ++pass) {  // the last label needs room that depends on the labels
      plot.width = std::round(chart_.size[0] - margin_ - overhang) - plot.x;
      layout_.x = makeChartScale(chart_.x, ranges_[0], false,
                                 [this](const ChartScale& scale) { return labelsFit(scale); });
      const double end =
          layout_.x.share(layout_.x.ticks.back()) * plot.width + labelWidth(layout_.x.labels.back()) / 2;
      overhang = std::max(overhang, end - plot.width);
    }
    plot.width = std::round(chart_.size[0] - margin_ - overhang) - plot.x;
    layout_.y2LabelsStart = plot.right() + kYLabelGap * size_;
  }

  /// Width of the title and the labels of a vertical axis.
  double besidePlot(const ChartAxis& axis, const ChartScale& scale) const {
    const double title = axis.title.empty() ? 0.0 : (kHalfLine + kYTitleGap) * size_;
    return title + longest(scale.labels) + kYLabelGap * size_;
  }

  bool labelsFit(const ChartScale& scale) const {
    double end = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < scale.ticks.size(); ++k) {
      const double middle = scale.share(scale.ticks[k]) * layout_.plot.width;
      const double half = labelWidth(scale.labels[k]) / 2;
      if (middle - half < end + kBetweenLabels * size_) return false;
      end = middle + half;
    }
    return true;
  }

  void checkRoom() const {
    if (layout_.plot.width < kSmallestPlotWidth * size_ || layout_.plot.height < kSmallestPlotHeight * size_)
      throw Error(fmt::format(
          "chart: the texts leave no room for the curves in {} x {}; take a larger size or fewer labels",
          chart_.size[0], chart_.size[1]));
  }

  void placeTitles() {
    const double width = chart_.size[0], height = chart_.size[1];
    const PixelRect& plot = layout_.plot;
    const auto fitted = [&](const std::string& text, double size, double room) {
      const TextStyle style{.size = size, .font = chart_.theme.font};
      if (text.empty()) return FittedText{};
      const std::size_t unit = unitIn(text);
      return fitName({{text.substr(0, unit)}}, {{text.substr(unit)}}, style, room, kSmallestText * size_);
    };
    // The middle of a text that stands at the middle of the plot unless it would leave the picture.
    const auto middle = [&](const FittedText& text, double wanted, double room) {
      const double half = textWidth(text.text, text.style) / 2;
      return std::clamp(wanted, margin_ + half, std::max(margin_ + half, room - margin_ - half));
    };
    double besideFactor = width - 2 * margin_;
    if (!layout_.x.factor.empty())
      besideFactor = plot.width - 2 * (labelWidth(layout_.x.factor) + kBetweenLabels * size_);
    layout_.title = fitted(chart_.title, kTitleSize * size_, width - 2 * margin_);
    layout_.xTitle = fitted(chart_.x.title, size_, besideFactor);
    layout_.yTitle = fitted(chart_.y.title, size_, height - 2 * margin_);
    if (layout_.y2) layout_.y2Title = fitted(chart_.y2.title, size_, height - 2 * margin_);
    layout_.titleAt = {middle(layout_.title, plot.center().x(), width),
                       height - margin_ - kTitleSize * kHalfLine * size_};
    layout_.xTitleAt = {middle(layout_.xTitle, plot.center().x(), width), titleLine_};
    layout_.yTitleAt = {margin_ + kHalfLine * size_, middle(layout_.yTitle, plot.center().y(), height)};
    layout_.y2TitleAt = {width - margin_ - kHalfLine * size_,
                         middle(layout_.y2Title, plot.center().y(), height)};
    layout_.xFactorAt = {plot.right(), titleLine_};
    layout_.yFactorAt = {plot.x, plot.top() + kFactorRise * size_};
    layout_.y2FactorAt = {plot.right(), plot.top() + kFactorRise * size_};
  }

  const Chart& chart_;
  ChartLayout& layout_;
  double size_, margin_;
  DataRanges ranges_ = dataRanges(chart_);
  double titleLine_ = 0.0;
};

}  // namespace

Eigen::Vector2d ChartLayout::pixel(double xValue, double yValue, bool onRight) const {
  const double height = onRight ? y2->share(yValue) : y.share(yValue);
  return {plot.x + x.share(xValue) * plot.width, plot.y + height * plot.height};
}

ChartLayout layOutChart(const Chart& chart) {
  const double size = chart.theme.textSize * chartTextSize(chart.size);
  ChartLayout layout;
  layout.textSize = size;
  layout.legend = ChartLegend(chart, size, kWidestLabel * chart.size[0]);
  Arrangement(chart, layout, 0.0);
  if (layout.legend.entries().empty()) return layout;
  if (const auto place = layout.legend.freePlace(layout.plot, layout.curves)) {
    layout.legendBox = *place;
    layout.legendInside = true;
    return layout;
  }
  const double margin = kMargin * size;
  layout.legendColumns = layout.legend.columnsIn(chart.size[0] - 2 * margin);
  const Eigen::Vector2d extent = layout.legend.extent(layout.legendColumns);
  Arrangement(chart, layout, extent.y() + (kLegendGap - kHalfLine) * size);
  const double left =
      std::min(layout.plot.center().x() - extent.x() / 2, chart.size[0] - margin - extent.x());
  layout.legendBox = {std::max(margin, left), margin, extent.x(), extent.y()};
  return layout;
}

}  // namespace burnish
