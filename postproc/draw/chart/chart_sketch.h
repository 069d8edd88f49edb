#pragma once
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "postproc/draw/chart/chart_layout.h"

namespace burnish {

struct SketchLine {
  Polyline points;
  double width;
  Color color;
};

struct SketchArea {
  Polyline corners;  ///< of a convex polygon
  Color color;
};

struct SketchText {
  std::string text;
  Eigen::Vector2d at;  ///< at half the height of the capitals
  TextStyle style;
  Overlay::Anchor anchor = Overlay::Anchor::Middle;
  Overlay::Direction direction = Overlay::Direction::Right;
};

/// A chart as plain shapes, in the order in which they are painted; all lengths in pixels.
struct ChartSketch {
  std::array<int, 2> size{};
  Color paper{255, 255, 255};
  std::vector<std::variant<SketchLine, SketchArea, SketchText>> shapes;
};

ChartSketch sketchChart(const ChartLayout& layout, const std::array<int, 2>& size, const Theme& theme);

}  // namespace burnish
