#pragma once
#include "postproc/draw/page/page_sketch.h"

namespace burnish {

/// Puts lines and areas in pixels (see PixelRect) on a sketch. What is added later lies over what was added
/// before.
class FlatShapes {
 public:
  using Points = PagePoints;

  explicit FlatShapes(PageSketch& sketch) : sketch_(sketch) {}

  void addConvexPolygon(const Points& corners, const Color& color);

  void addPolyline(const Points& points, double width, const Color& color);

  /// Line segments from even to odd points.
  void addSegments(const Points& points, double width, const Color& color);

 private:
  PageSketch& sketch_;
};

}  // namespace burnish
