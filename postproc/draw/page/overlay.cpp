#include "postproc/draw/page/overlay.h"

#include "postproc/draw/page/flat_shapes.h"

namespace burnish {

void Overlay::addText(const RichText& text, const Eigen::Vector2d& at, const TextStyle& style, Anchor anchor,
                      Direction direction) {
  for (const TextRun& run : text) noteDrawnText(run.text, style.font);
  sketch_.shapes.emplace_back(PageText{text, at, style, anchor, direction});
}

void Overlay::addSegments(const std::vector<Eigen::Vector2d>& points, double width, const Color& color) {
  FlatShapes(sketch_).addSegments(points, width, color);
}

void Overlay::addStripes(const PixelRect& rect, const std::vector<Color>& colors, Direction direction) {
  sketch_.shapes.emplace_back(PageStripes{rect, colors, direction});
}

}  // namespace burnish
