#include "postproc/draw/chart/chart_legend.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burnish {
namespace {

// Parts of the text size.
constexpr double kLegendPadding = 0.5;
constexpr double kRow = 1.4;
constexpr double kSample = 2.9;  ///< shows two periods of every dash pattern
constexpr double kSampleGap = 0.5;
constexpr double kColumnGap = 1.3;
constexpr double kInset = 0.6;      ///< from the frame of the plot
constexpr double kClearance = 0.5;  ///< from lines and the middle of markers
constexpr double kSmallestLabel = 0.8;

PixelRect grown(const PixelRect& rect, double margin) {
  return {rect.x - margin, rect.y - margin, rect.width + 2 * margin, rect.height + 2 * margin};
}

bool covers(const PixelRect& rect, const Polyline& line) {
  for (std::size_t k = 0; k < line.size(); ++k)
    if (clipSegment(line[k == 0 ? 0 : k - 1], line[k], rect)) return true;
  return false;
}

bool coversPoint(const PixelRect& rect, const Polyline& points) {
  return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector2d& p) {
    return p.x() > rect.x && p.x() < rect.right() && p.y() > rect.y && p.y() < rect.top();
  });
}

bool covers(const PixelRect& rect, const PlottedCurve& curve) {
  const auto coversPiece = [&](const Polyline& piece) {
    return piece.size() == 1 ? coversPoint(rect, piece) : covers(rect, piece);
  };
  return coversPoint(rect, curve.markers) ||
         std::any_of(curve.pieces.begin(), curve.pieces.end(), coversPiece);
}

}  // namespace

ChartLegend::ChartLegend(const Chart& chart, double textSize, double widestLabel) : size_(textSize) {
  const TextStyle style{.size = size_, .font = chart.theme.font};
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const std::string& label = chart.curves[k].label;
    if (label.empty() || !chart.legend) continue;
    const RichText side = chart.curves[k].onRight ? RichText{{" (right)"}} : RichText{};
    FittedText fitted =
        fitText({{label}}, style, widestLabel - textWidth(side, style), kSmallestLabel * size_);
    fitted.text.insert(fitted.text.end(), side.begin(), side.end());
    longestLabel_ = std::max(longestLabel_, textWidth(fitted.text, fitted.style));
    entries_.push_back({k, std::move(fitted)});
  }
}

double ChartLegend::sampleLength() const {
  return kSample * size_;
}

double ChartLegend::labelOffset() const {
  return (kSample + kSampleGap) * size_;
}

Eigen::Vector2d ChartLegend::extent(int columns) const {
  const auto rows = std::ceil(static_cast<double>(entries_.size()) / columns);
  return {columns * (labelOffset() + longestLabel_) + (columns - 1) * kColumnGap * size_ +
              2 * kLegendPadding * size_,
          (rows * kRow + 2 * kLegendPadding - (kRow - 1.0)) * size_};
}

int ChartLegend::columnsIn(double width) const {
  int columns = std::max(1, static_cast<int>(entries_.size()));
  while (columns > 1 && extent(columns).x() > width) --columns;
  // The same number of rows with fewer columns is more even.
  const auto rows = [&](int n) { return (static_cast<int>(entries_.size()) + n - 1) / n; };
  while (columns > 1 && rows(columns - 1) == rows(columns)) --columns;
  return columns;
}

std::optional<PixelRect> ChartLegend::freePlace(const PixelRect& plot,
                                                const std::vector<PlottedCurve>& curves) const {
  const Eigen::Vector2d own = extent(1);
  const PixelRect room = grown(plot, -kInset * size_);
  if (own.x() > room.width || own.y() > room.height) return std::nullopt;
  using Share = Eigen::Vector2d;  // of the room that is left and below the legend
  for (const Share& share : {Share(1, 1), Share(0, 1), Share(1, 0), Share(0, 0), Share(0.5, 1), Share(0.5, 0),
                             Share(1, 0.5), Share(0, 0.5)}) {
    const PixelRect box{room.x + share.x() * (room.width - own.x()),
                        room.y + share.y() * (room.height - own.y()), own.x(), own.y()};
    const auto hides = [cleared = grown(box, kClearance * size_)](const PlottedCurve& curve) {
      return covers(cleared, curve);
    };
    if (std::none_of(curves.begin(), curves.end(), hides)) return box;
  }
  return std::nullopt;
}

std::vector<Eigen::Vector2d> ChartLegend::entryStarts(const PixelRect& box, int columns) const {
  const int count = static_cast<int>(entries_.size());
  const int rows = (count + columns - 1) / columns;
  const double columnStep = labelOffset() + longestLabel_ + kColumnGap * size_;
  std::vector<Eigen::Vector2d> starts;
  for (int k = 0; k < count; ++k) {
    const int column = k / rows, row = k % rows;
    starts.emplace_back(box.x + kLegendPadding * size_ + column * columnStep,
                        box.top() - (kLegendPadding + 0.5 + row * kRow) * size_);
  }
  return starts;
}

}  // namespace burnish
