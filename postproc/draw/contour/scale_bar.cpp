#include "postproc/draw/contour/scale_bar.h"

#include <algorithm>
#include <cmath>

#include "postproc/text/ticks.h"

namespace burnish {

double roundLength(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

void drawScaleBar(FlatShapes& shapes, Overlay& overlay, const View& view, const Eigen::Vector2d& corner,
                  const std::string& unit, double textSize, const Theme& theme) {
  // Parts of the text size, and of the width of what is seen.
  constexpr double kEndHeight = 0.5, kThickness = 0.12, kBeforeText = 0.5, kPartOfWidth = 0.3;
  const double length = roundLength(kPartOfWidth * view.area.width / view.pixelsPerLength);
  const double pixels = length * view.pixelsPerLength,
               width = std::max(1.0, std::round(kThickness * textSize));
  const TextStyle style{0.85 * textSize, theme.ink, theme.font};
  const double capitals = capitalHeight(style), middle = corner.y() + 0.5 * capitals,
               half = 0.5 * kEndHeight * textSize;
  const Eigen::Vector2d begin(corner.x(), middle), end(corner.x() + pixels, middle), up(0.0, half);
  const Eigen::Vector2d within(0.5 * width, 0.0);  // from edge to edge it is as long as it says
  shapes.addSegments(
      {begin, end, begin + within - up, begin + within + up, end - within - up, end - within + up}, width,
      theme.ink);
  overlay.addText({{numberText(length, 3) + (unit.empty() ? "" : " " + unit)}},
                  {end.x() + kBeforeText * textSize, corner.y()}, style);
}

}  // namespace burnish
