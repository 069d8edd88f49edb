#include "postproc/draw/contour/length_axes.h"

#include <algorithm>
#include <cmath>

#include "postproc/text/ticks.h"

namespace burnish {
namespace {

// Parts of the text size.
constexpr double kAxisLabel = 0.9, kAxisTick = 0.35, kAxisGap = 0.3, kAxisTitleGap = 0.6, kBetweenTicks = 1.0;

constexpr const char* kWidestAxisLabel = "0.00";

TextStyle labelStyleOf(double textSize, const Theme& theme) {
  return {kAxisLabel * textSize, theme.ink, theme.font};
}

/// With as many as have room.
Ticks ticksOf(double length, double pixels, double apart) {
  constexpr int kMost = 7;
  return makeTicks({0.0, length}, std::clamp(static_cast<int>(pixels / apart), 2, kMost));
}

std::string axisTitle(const char* words, int exponent, const std::string& unit) {
  const std::string power = exponent == 0 ? "" : "10" + superscript(exponent);
  const std::string both = power + (power.empty() || unit.empty() ? "" : " ") + unit;
  return both.empty() ? words : std::string(words) + " [" + both + "]";
}

}  // namespace

Eigen::Vector2d lengthAxesRoom(double textSize, const Theme& theme) {
  const TextStyle style = labelStyleOf(textSize, theme);
  const double besideLabels =
      textSize * (kAxisTick + kAxisGap + kAxisTitleGap + kAxisGap) + capitalHeight(style);
  return {std::ceil(besideLabels + textWidth({{kWidestAxisLabel}}, style)),
          std::ceil(besideLabels + capitalHeight(style))};
}

void drawLengthAxes(FlatShapes& shapes, Overlay& overlay, const View& view, const Eigen::AlignedBox2d& box,
                    const std::string& unit, double textSize, const Theme& theme) {
  const TextStyle style = labelStyleOf(textSize, theme);
  const double capitals = capitalHeight(style), line = std::max(1.0, textSize / 20.0),
               widest = textWidth({{kWidestAxisLabel}}, style);
  // On the middles of pixels, where thin lines are crisp.
  const auto crisp = [](double pixel) { return std::floor(pixel) + 0.5; };
  const Eigen::Vector2d low = view.pixel(box.min()).unaryExpr(crisp),
                        high = view.pixel(box.max()).unaryExpr(crisp);
  shapes.addPolyline({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, line, theme.ink);
  const Ticks across = ticksOf(box.sizes().x(), high.x() - low.x(), widest + kBetweenTicks * textSize),
              up = ticksOf(box.sizes().y(), high.y() - low.y(), capitals + kBetweenTicks * textSize);
  FlatShapes::Points marks;
  const double labelBase = low.y() - textSize * (kAxisTick + kAxisGap) - capitals,
               labelEnd = low.x() - textSize * (kAxisTick + kAxisGap);
  for (std::size_t k = 0; k < across.values.size(); ++k) {
    const double at = crisp(view.pixel(box.min() + Eigen::Vector2d(across.values[k], 0.0)).x());
    marks.emplace_back(at, low.y());
    marks.emplace_back(at, low.y() - kAxisTick * textSize);
    overlay.addText({{across.labels[k]}}, {at, labelBase}, style, Overlay::Anchor::Middle);
  }
  for (std::size_t k = 0; k < up.values.size(); ++k) {
    const double at = crisp(view.pixel(box.min() + Eigen::Vector2d(0.0, up.values[k])).y());
    marks.emplace_back(low.x(), at);
    marks.emplace_back(low.x() - kAxisTick * textSize, at);
    overlay.addText({{up.labels[k]}}, {labelEnd, at - capitals / 2.0}, style, Overlay::Anchor::End);
  }
  shapes.addSegments(marks, line, theme.ink);
  const Eigen::Vector2d middle = 0.5 * (low + high);
  overlay.addText({{axisTitle("Along the face", across.exponent, unit)}},
                  {middle.x(), labelBase - kAxisTitleGap * textSize - capitals}, style,
                  Overlay::Anchor::Middle);
  overlay.addText({{axisTitle("Across", up.exponent, unit)}},
                  {labelEnd - widest - kAxisTitleGap * textSize, middle.y()}, style, Overlay::Anchor::Middle,
                  Overlay::Direction::Up);
}

}  // namespace burnish
