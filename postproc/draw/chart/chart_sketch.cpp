#include "postproc/draw/chart/chart_sketch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace burnish {
namespace {

using Anchor = Overlay::Anchor;
using Direction = Overlay::Direction;

// How much ink is in the colours between paper and ink.
constexpr double kFrameInk = 0.87, kGridInk = 0.147;

// Parts of the text size.
constexpr double kCurveWidth = 0.12;
constexpr double kFrameWidth = 0.06;
constexpr double kGridWidth = 0.045;
constexpr double kTick = 0.3, kMinorTick = 0.17;
constexpr double kMarker = 0.24;  ///< half the width
constexpr double kMarkerRim = 0.07;

Color mixed(const Theme& theme, double ink) {
  Color result;
  for (std::size_t c = 0; c < result.size(); ++c)
    result[c] =
        static_cast<unsigned char>(std::lround(theme.paper[c] + ink * (theme.ink[c] - theme.paper[c])));
  return result;
}

class Sketcher {
 public:
  Sketcher(const ChartLayout& layout, const std::array<int, 2>& size, const Theme& theme)
      : layout_(layout),
        theme_(theme),
        frame_(mixed(theme, kFrameInk)),
        grid_(mixed(theme, kGridInk)),
        size_(layout.textSize) {
    sketch_.size = size;
    sketch_.paper = theme.paper;
    if (theme.paper != Color{255, 255, 255}) addPaper();
    addGrid();
    addTicks();
    addFrame(layout.plot, kFrameWidth);
    addCurves();
    if (!layout.legend.entries().empty()) addLegend();
    addTexts();
  }

  ChartSketch result() && { return std::move(sketch_); }

 private:
  /// width: in text sizes; thinner lines than a pixel would be pale.
  void addLine(Polyline points, double width, const Color& color) {
    sketch_.shapes.emplace_back(SketchLine{std::move(points), std::max(1.0, width * size_), color});
  }

  /// A PDF has no other paper than white.
  void addPaper() {
    const double width = sketch_.size[0], height = sketch_.size[1];
    sketch_.shapes.emplace_back(
        SketchArea{{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}, theme_.paper});
  }

  void addFrame(const PixelRect& r, double width) {
    const double out = width * size_ / 2;  // lines have blunt ends
    for (const double x : {r.x, r.right()}) addLine({{x, r.y - out}, {x, r.top() + out}}, width, frame_);
    for (const double y : {r.y, r.top()}) addLine({{r.x - out, y}, {r.right() + out, y}}, width, frame_);
  }

  double xOf(double value) const { return layout_.plot.x + layout_.x.share(value) * layout_.plot.width; }
  double yOf(double value) const { return layout_.plot.y + layout_.y.share(value) * layout_.plot.height; }

  void addGrid() {
    const PixelRect& plot = layout_.plot;
    for (const double value : layout_.x.ticks)
      addLine({{xOf(value), plot.y}, {xOf(value), plot.top()}}, kGridWidth, grid_);
    for (const double value : layout_.y.ticks)
      addLine({{plot.x, yOf(value)}, {plot.right(), yOf(value)}}, kGridWidth, grid_);
  }

  void addTicks() {
    const PixelRect& plot = layout_.plot;
    addTicks(layout_.x, {plot.x, plot.y}, {plot.width, 0.0}, {0.0, size_});
    addTicks(layout_.y, {plot.x, plot.y}, {0.0, plot.height}, {size_, 0.0});
    if (layout_.y2) addTicks(*layout_.y2, {plot.right(), plot.y}, {0.0, plot.height}, {-size_, 0.0});
  }

  /// inwards: as long as the text is high.
  void addTicks(const ChartScale& scale, const Eigen::Vector2d& start, const Eigen::Vector2d& axis,
                const Eigen::Vector2d& inwards) {
    const auto add = [&](double value, double length) {
      const Eigen::Vector2d at = start + scale.share(value) * axis;
      addLine({at, at + length * inwards}, kFrameWidth, frame_);
    };
    for (const double value : scale.ticks) add(value, kTick);
    for (const double value : scale.minorTicks) add(value, kMinorTick);
  }

  /// Solid lines first, so that they show in the gaps of dashed ones; then all markers.
  void addCurves() {
    std::vector<std::size_t> order(layout_.curves.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return dashPattern(layout_.curves[a].style).size() < dashPattern(layout_.curves[b].style).size();
    });
    for (const std::size_t k : order) {
      const CurveStyle& style = layout_.curves[k].style;
      // Curves that coincide have their gaps at different places.
      const double start = static_cast<double>(k) / static_cast<double>(order.size()) * period(style);
      for (const Polyline& piece : layout_.curves[k].pieces) addStroke(piece, style, start);
    }
    for (const std::size_t k : order)
      for (const Eigen::Vector2d& at : layout_.curves[k].markers) addMarker(at, layout_.curves[k].style);
  }

  std::vector<double> dashLengths(const CurveStyle& style) const {
    std::vector<double> pattern = dashPattern(style);
    for (double& length : pattern) length *= kCurveWidth * size_;
    return pattern;
  }

  double period(const CurveStyle& style) const {
    const std::vector<double> lengths = dashLengths(style);
    return std::accumulate(lengths.begin(), lengths.end(), 0.0);
  }

  /// A line in the dashes of a style. start: the place in their period where it begins, in pixels.
  void addStroke(const Polyline& line, const CurveStyle& style, double start) {
    const Color color = curveColor(style, theme_);
    for (const Polyline& dash : dashes(line, dashLengths(style), start)) addRounded(dash, color);
  }

  /// A line with discs at sharp corners, where one stroke would leave a notch or a spike, and for a lone
  /// point.
  void addRounded(const Polyline& line, const Color& color) {
    constexpr double sharp = 0.94;  // cosine of 20 degrees
    if (line.size() == 1) return addDisc(line.front(), color);
    Polyline part{line.front()};
    for (std::size_t k = 1; k < line.size(); ++k) {
      part.push_back(line[k]);
      if (k + 1 == line.size()) break;
      const Eigen::Vector2d before = line[k] - line[k - 1], after = line[k + 1] - line[k];
      if (before.dot(after) > sharp * before.norm() * after.norm()) continue;
      addDisc(line[k], color);
      addLine(std::exchange(part, {line[k]}), kCurveWidth, color);
    }
    addLine(std::move(part), kCurveWidth, color);
  }

  /// As wide as a curve.
  void addDisc(const Eigen::Vector2d& middle, const Color& color) {
    constexpr int corners = 12;
    Polyline disc;
    for (int c = 0; c < corners; ++c) {
      const double angle = 2.0 * std::numbers::pi * c / corners;
      disc.push_back(middle + kCurveWidth / 2 * size_ * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    sketch_.shapes.emplace_back(SketchArea{std::move(disc), color});
  }

  /// A shape with a white rim, which sets it off from other curves.
  void addMarker(const Eigen::Vector2d& at, const CurveStyle& style) {
    const auto add = [&](double halfWidth, const Color& color) {
      Polyline outline = markerOutline(style, halfWidth * size_);
      for (Eigen::Vector2d& point : outline) point += at;
      sketch_.shapes.emplace_back(SketchArea{std::move(outline), color});
    };
    add(kMarker + kMarkerRim, theme_.paper);
    add(kMarker, curveColor(style, theme_));
    if (!markerIsFilled(style)) add(kMarker / 2, theme_.paper);
  }

  /// A piece of line with the middle of a dash in its middle, a marker, or both.
  void addSample(const Eigen::Vector2d& start, double length, const CurveStyle& style) {
    const Eigen::Vector2d along(length, 0.0);
    const std::vector<double> pattern = dashLengths(style);
    const double before = pattern.empty() ? 0.0 : (pattern.front() - length) / 2;
    const double periods = pattern.empty() ? 0.0 : std::ceil(-before / period(style));
    if (style.line) addStroke({start, start + along}, style, before + periods * period(style));
    if (style.marker >= 0) addMarker(start + along / 2, style);
  }

  void addLegend() {
    const ChartLegend& legend = layout_.legend;
    if (layout_.legendInside) {
      const PixelRect& box = layout_.legendBox;
      sketch_.shapes.emplace_back(
          SketchArea{{{box.x, box.y}, {box.right(), box.y}, {box.right(), box.top()}, {box.x, box.top()}},
                     theme_.paper});
      addFrame(box, kGridWidth);
    }
    const auto starts = legend.entryStarts(layout_.legendBox, layout_.legendColumns);
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const ChartLegend::Entry& entry = legend.entries()[k];
      addSample(starts[k], legend.sampleLength(), layout_.curves[entry.curve].style);
      addText(entry.label, starts[k] + Eigen::Vector2d(legend.labelOffset(), 0.0), Anchor::Start);
    }
  }

  void addText(const FittedText& text, const Eigen::Vector2d& at, Anchor anchor,
               Direction direction = Direction::Right) {
    std::string joined;
    for (const TextRun& run : text.text) joined += run.text;  // one, and "…" when it had to be shortened
    addLabel(joined, at, text.style.size, anchor, direction);
  }

  void addLabel(const std::string& label, const Eigen::Vector2d& at, double size, Anchor anchor,
                Direction direction = Direction::Right) {
    if (!label.empty())
      sketch_.shapes.emplace_back(SketchText{label, at, {size, theme_.ink, theme_.font}, anchor, direction});
  }

  void addTexts() {
    for (std::size_t k = 0; k < layout_.x.ticks.size(); ++k)
      addLabel(layout_.x.labels[k], {xOf(layout_.x.ticks[k]), layout_.xLabelsAt}, size_, Anchor::Middle);
    for (std::size_t k = 0; k < layout_.y.ticks.size(); ++k)
      addLabel(layout_.y.labels[k], {layout_.yLabelsEnd, yOf(layout_.y.ticks[k])}, size_, Anchor::End);
    if (layout_.y2) addRightTexts(*layout_.y2);
    addLabel(layout_.x.factor, layout_.xFactorAt, size_, Anchor::End);
    addLabel(layout_.y.factor, layout_.yFactorAt, size_, Anchor::Start);
    addText(layout_.title, layout_.titleAt, Anchor::Middle);
    addText(layout_.xTitle, layout_.xTitleAt, Anchor::Middle);
    addText(layout_.yTitle, layout_.yTitleAt, Anchor::Middle, Direction::Up);
  }

  void addRightTexts(const ChartScale& scale) {
    const PixelRect& plot = layout_.plot;
    for (std::size_t k = 0; k < scale.ticks.size(); ++k)
      addLabel(scale.labels[k], {layout_.y2LabelsStart, plot.y + scale.share(scale.ticks[k]) * plot.height},
               size_, Anchor::Start);
    addLabel(scale.factor, layout_.y2FactorAt, size_, Anchor::End);
    addText(layout_.y2Title, layout_.y2TitleAt, Anchor::Middle, Direction::Up);
  }

  const ChartLayout& layout_;
  const Theme& theme_;
  Color frame_, grid_;
  double size_;
  ChartSketch sketch_;
};

}  // namespace

ChartSketch sketchChart(const ChartLayout& layout, const std::array<int, 2>& size, const Theme& theme) {
  return Sketcher(layout, size, theme).result();
}

}  // namespace burnish
