#include "postproc/draw/page/flat_shapes.h"

#include <cstddef>

namespace burnish {

void FlatShapes::addConvexPolygon(const Points& corners, const Color& color) {
  sketch_.shapes.emplace_back(PageArea{corners, color});
}

void FlatShapes::addPolyline(const Points& points, double width, const Color& color) {
  sketch_.shapes.emplace_back(PageLines{{points}, width, color});
}

void FlatShapes::addSegments(const Points& points, double width, const Color& color) {
  PageLines segments{{}, width, color};
  for (std::size_t k = 0; k + 1 < points.size(); k += 2) segments.lines.push_back({points[k], points[k + 1]});
  sketch_.shapes.emplace_back(std::move(segments));
}

}  // namespace burnish
