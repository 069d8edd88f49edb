#include "postproc/draw/chart/chart_curves.h"

#include <vtkBox.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace burnish {
namespace {

/// The palette of Okabe and Ito without its yellow, which is too pale on paper. Brightness in grey, in parts
/// of 255: 87, 162, 0, 119, 158, 106, 151.
constexpr std::array<Color, 7> kPalette{
    {{0, 114, 178}, {230, 159, 0}, {0, 0, 0}, {213, 94, 0}, {86, 180, 233}, {0, 158, 115}, {204, 121, 167}}};

/// A marker: corners of a regular polygon, direction of the first one in degrees, and size that makes all
/// look alike.
struct MarkerShape {
  int corners;
  double firstCorner;
  double size;
};
constexpr std::array<MarkerShape, 6> kMarkers{
    {{40, 0, 1.0}, {4, 45, 1.25}, {3, 90, 1.4}, {4, 90, 1.3}, {3, 270, 1.4}, {40, 0, 1.0}}};

constexpr std::size_t kFewPoints = 20;  ///< every one gets a marker
constexpr int kSparseMarkers = 9;
constexpr double kSmallestStep = 0.25;  ///< pixels; points that lie closer together are drawn as one

template <class Container>
const auto& cyclic(const Container& container, int index) {
  return container[static_cast<std::size_t>(index) % std::size(container)];
}

/// Runs of finite points in pixels.
std::vector<Polyline> finiteRuns(const ChartCurve& curve, const PixelOf& pixel) {
  std::vector<Polyline> runs(1);
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]))
      runs.back().push_back(pixel(curve.x[k], curve.y[k], curve.onRight));
    else if (!runs.back().empty())
      runs.emplace_back();
  }
  if (runs.back().empty()) runs.pop_back();
  return runs;
}

Polyline withoutTinySteps(const Polyline& line) {
  Polyline kept{line.front()};
  for (const Eigen::Vector2d& point : line)
    if ((point - kept.back()).norm() >= kSmallestStep) kept.push_back(point);
  return kept;
}

/// More points than a curve needs to look as it does get thinned out.
std::size_t manyPoints(const PixelRect& plot) {
  return static_cast<std::size_t>(4.0 * plot.width);
}

/// Of points that follow each other within a column of pixels, the first, the last, the lowest and the
/// highest: the line through them covers the same pixels.
Polyline thinnedOut(const Polyline& line) {
  Polyline kept;
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
    const double column = std::floor(line[begin].x());
    std::size_t low = begin, high = begin;
    for (end = begin; end < line.size() && std::floor(line[end].x()) == column; ++end) {
      if (line[end].y() < line[low].y()) low = end;
      if (line[end].y() > line[high].y()) high = end;
    }
    std::array<std::size_t, 4> chosen{begin, std::min(low, high), std::max(low, high), end - 1};
    const auto last = std::unique(chosen.begin(), chosen.end());
    for (auto k = chosen.begin(); k != last; ++k) kept.push_back(line[*k]);
  }
  return kept;
}

/// Remembers where something has been drawn already that would hide another one there.
class Taken {
 public:
  /// cell: pixels within which one hides another.
  explicit Taken(double cell) : cell_(cell) {}

  /// Whether nothing has been drawn in the cell before.
  bool add(const Eigen::Vector2d& p) {
    return places_.insert({std::floor(p.x() / cell_), std::floor(p.y() / cell_)}).second;
  }

 private:
  double cell_;
  std::set<std::pair<double, double>> places_;
};

/// The pixels of a plot that a line has passed.
class Passed {
 public:
  explicit Passed(const PixelRect& plot)
      : corner_(plot.x, plot.y),
        columns_(static_cast<std::size_t>(std::ceil(plot.width)) + 2),
        rows_(static_cast<std::size_t>(std::ceil(plot.height)) + 2),
        pixels_(columns_ * rows_) {}

  /// Whether a segment of the plot passes a pixel for the first time.
  bool add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const int steps = 1 + static_cast<int>((b - a).lpNorm<Eigen::Infinity>());
    bool isNew = false;
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2d p = a + static_cast<double>(k) / steps * (b - a) - corner_;
      const auto column = static_cast<std::size_t>(std::max(0.0, p.x() + 1.0));
      const auto row = static_cast<std::size_t>(std::max(0.0, p.y() + 1.0));
      char& pixel = pixels_[std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1)];
      isNew = isNew || pixel == 0;
      pixel = 1;
    }
    return isNew;
  }

 private:
  Eigen::Vector2d corner_;
  std::size_t columns_, rows_;
  std::vector<char> pixels_;
};

/// Of lines that go to and fro, such as a cloud of points, without the stretches that pass no new pixel.
std::vector<Polyline> withoutRepeats(const std::vector<Polyline>& pieces, const PixelRect& plot) {
  constexpr double stretch = 8.0;  // pixels; shorter ones would leave notches in a line
  Passed passed(plot);
  std::vector<Polyline> kept;
  for (const Polyline& piece : pieces) {
    if (piece.size() == 1) kept.push_back(piece);
    bool open = false;
    for (std::size_t first = 0, last = 0; first + 1 < piece.size(); first = last) {
      bool isNew = false;
      for (double length = 0.0; last + 1 < piece.size() && length < stretch; ++last) {
        isNew = passed.add(piece[last], piece[last + 1]) || isNew;
        length += (piece[last + 1] - piece[last]).norm();
      }
      if (isNew && !open) kept.push_back({piece[first]});
      open = isNew;
      const auto begin = piece.begin();
      if (isNew)
        kept.back().insert(kept.back().end(), begin + static_cast<std::ptrdiff_t>(first) + 1,
                           begin + static_cast<std::ptrdiff_t>(last) + 1);
    }
  }
  return kept;
}

std::size_t numPoints(const std::vector<Polyline>& pieces) {
  std::size_t count = 0;
  for (const Polyline& piece : pieces) count += piece.size();
  return count;
}

bool contains(const PixelRect& rect, const Eigen::Vector2d& p) {
  constexpr double slack = 1e-6;
  return p.x() >= rect.x - slack && p.x() <= rect.right() + slack && p.y() >= rect.y - slack &&
         p.y() <= rect.top() + slack;
}

/// Appends the parts of a line that lie in the plot.
void appendClipped(const Polyline& line, const PixelRect& plot, std::vector<Polyline>& pieces) {
  if (line.size() == 1 && contains(plot, line.front())) pieces.push_back(line);
  bool open = false;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const auto part = clipSegment(line[k - 1], line[k], plot);
    if (!part) {
      open = false;
      continue;
    }
    if (!open) pieces.push_back({(*part)[0]});
    pieces.back().push_back((*part)[1]);
    open = (*part)[1] == line[k];
  }
}

/// Some points, at equal distances along the line; `phase` in [0, 1) moves them by a part of that distance.
Polyline spread(const Polyline& points, double phase) {
  std::vector<double> along(points.size());
  for (std::size_t k = 1; k < points.size(); ++k)
    along[k] = along[k - 1] + (points[k] - points[k - 1]).norm();
  Polyline chosen;
  for (int m = 0; m < kSparseMarkers; ++m) {
    const double target = along.back() * (m + phase) / kSparseMarkers;
    const auto next = std::lower_bound(along.begin(), along.end(), target);
    chosen.push_back(points[static_cast<std::size_t>(next - along.begin())]);
  }
  return chosen;
}

/// most: more points than that get a few markers only.
PlottedCurve plotCurve(const ChartCurve& curve, const CurveStyle& style, const PixelRect& plot,
                       const PixelOf& pixel, std::size_t most, double phase) {
  PlottedCurve plotted;
  plotted.style = style;
  Polyline visible;
  const bool many = curve.x.size() > manyPoints(plot);
  Taken alone(0.5), marked(3.0);
  for (const Polyline& run : finiteRuns(curve, pixel)) {
    if (many && run.size() == 1 && !alone.add(run.front())) continue;
    if (style.line) {
      const Polyline line = withoutTinySteps(run);
      appendClipped(many ? thinnedOut(line) : line, plot, plotted.pieces);
    }
    std::copy_if(run.begin(), run.end(), std::back_inserter(visible),
                 [&](const Eigen::Vector2d& point) { return contains(plot, point); });
  }
  if (many && numPoints(plotted.pieces) > 2 * manyPoints(plot))
    plotted.pieces = withoutRepeats(plotted.pieces, plot);
  if (style.marker < 0 || visible.empty()) return plotted;
  plotted.markers = visible.size() <= most ? visible : spread(visible, phase);
  if (plotted.markers.size() > manyPoints(plot))
    std::erase_if(plotted.markers, [&](const Eigen::Vector2d& at) { return !marked.add(at); });
  return plotted;
}

}  // namespace

Color curveColor(const CurveStyle& style, const Theme& theme) {
  const Color& color = cyclic(kPalette, style.color);
  const bool onDark = theme.paper[1] < theme.ink[1];
  return onDark && color == Color{0, 0, 0} ? theme.ink : color;
}

const std::vector<double>& dashPattern(const CurveStyle& style) {
  static const std::array<std::vector<double>, 4> patterns{
      {{}, {5.0, 3.0}, {1.5, 1.8}, {6.0, 2.2, 1.5, 2.2}}};
  return cyclic(patterns, style.dash);
}

Polyline markerOutline(const CurveStyle& style, double halfWidth) {
  const MarkerShape& shape = cyclic(kMarkers, style.marker);
  Polyline outline;
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = (shape.firstCorner / 180.0 + 2.0 * k / shape.corners) * std::numbers::pi;
    outline.push_back(halfWidth * shape.size * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

bool markerIsFilled(const CurveStyle& style) {
  return style.marker % 2 == 0;
}

CurveStyle defaultStyle(const Chart& chart, std::size_t number) {
  const int index = static_cast<int>(number);
  const bool useful = chart.curves.size() > 1 || chart.curves[number].x.size() <= kFewPoints;
  const bool marked = chart.markers == ChartMarkers::All || (chart.markers == ChartMarkers::Some && useful);
  return {index, index, marked ? index : -1};
}

std::vector<PlottedCurve> plotCurves(const Chart& chart, const PixelRect& plot, const PixelOf& pixel) {
  std::vector<PlottedCurve> plotted;
  const std::size_t count = chart.curves.size();
  for (std::size_t k = 0; k < count; ++k) {
    const ChartCurve& curve = chart.curves[k];
    const CurveStyle style = curve.style.value_or(defaultStyle(chart, k));
    const bool all = curve.style ? !style.line : chart.markers == ChartMarkers::All;
    const std::size_t most = all ? curve.x.size() : kFewPoints;
    const double phase = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    plotted.push_back(plotCurve(curve, style, plot, pixel, most, phase));
  }
  return plotted;
}

std::optional<std::array<Eigen::Vector2d, 2>> clipSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                                          const PixelRect& rect) {
  const std::array<double, 6> box{rect.x, rect.right(), rect.y, rect.top(), -1.0, 1.0};
  const std::array<double, 3> from{a.x(), a.y(), 0.0}, to{b.x(), b.y(), 0.0};
  double first = 0.0, last = 1.0;
  int firstPlane = -1, lastPlane = -1;
  if (!vtkBox::IntersectWithLine(box.data(), from.data(), to.data(), first, last, nullptr, nullptr,
                                 firstPlane, lastPlane))
    return std::nullopt;
  const auto at = [&](double t) { return t >= 1.0 ? b : Eigen::Vector2d(a + t * (b - a)); };
  return std::array{at(first), at(last)};
}

std::vector<Polyline> dashes(const Polyline& line, const std::vector<double>& pattern, double start) {
  if (pattern.empty() || line.size() < 2) return {line};
  const double period = std::accumulate(pattern.begin(), pattern.end(), 0.0);
  std::size_t part = 0;
  double left = std::fmod(start, period);
  for (; left >= pattern[part]; part = (part + 1) % pattern.size()) left -= pattern[part];
  left = pattern[part] - left;  // of the current dash or gap

  std::vector<Polyline> result;
  const auto begin = [&](const Eigen::Vector2d& p) {
    if (part % 2 == 0) result.push_back({p});
  };
  begin(line.front());
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Eigen::Vector2d step = line[k] - line[k - 1];
    const double length = step.norm();
    double done = 0.0;
    while (length - done > left) {
      done += left;
      const Eigen::Vector2d p = line[k - 1] + done / length * step;
      if (part % 2 == 0) result.back().push_back(p);
      part = (part + 1) % pattern.size();
      left = pattern[part];
      begin(p);
    }
    left -= length - done;
    if (part % 2 == 0) result.back().push_back(line[k]);
  }
  return result;
}

}  // namespace burnish
