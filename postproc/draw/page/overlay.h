#pragma once
#include <Eigen/Dense>
#include <vector>

#include "postproc/draw/page/page_sketch.h"
#include "postproc/draw/page/text_layout.h"

namespace burnish {

/// Puts what is drawn over a picture in pixels (see PixelRect) on a sketch.
class Overlay {
 public:
  using Anchor = TextAnchor;
  using Direction = TextDirection;

  explicit Overlay(PageSketch& sketch) : sketch_(sketch) {}

  /// `at`: the start, the middle or the end of the text's baseline.
  void addText(const RichText& text, const Eigen::Vector2d& at, const TextStyle& style,
               Anchor anchor = Anchor::Start, Direction direction = Direction::Right);

  /// Line segments from even to odd points.
  void addSegments(const std::vector<Eigen::Vector2d>& points, double width, const Color& color);

  /// A rectangle in stripes of these colours, from left to right or from bottom to top.
  void addStripes(const PixelRect& rect, const std::vector<Color>& colors, Direction direction);

 private:
  PageSketch& sketch_;
};

}  // namespace burnish
