#include "postproc/draw/page/page_sketch.h"

#include <cstddef>

namespace burnish {
namespace {

/// Scales and moves the shapes of a sketch.
class Placement {
 public:
  Placement(double scale, const Eigen::Vector2d& shift) : scale_(scale), shift_(shift) {}

  void operator()(PageLines& lines) const {
    for (PagePoints& line : lines.lines) place(line);
    lines.width *= scale_;
    if (lines.within) place(*lines.within);
  }

  void operator()(PageArea& area) const {
    place(area.corners);
    if (area.within) place(*area.within);
  }

  void operator()(PageRegion& region) const {
    for (PagePoints& loop : region.loops) place(loop);
    if (region.within) place(*region.within);
  }

  void operator()(PageStripes& stripes) const { place(stripes.rect); }

  void operator()(PageText& text) const {
    text.at = scale_ * text.at + shift_;
    text.style.size *= scale_;
  }

  void operator()(PageImage& image) const { place(image.rect); }

 private:
  void place(PagePoints& points) const {
    for (Eigen::Vector2d& point : points) point = scale_ * point + shift_;
  }

  void place(PixelRect& rect) const {
    rect = {scale_ * rect.x + shift_.x(), scale_ * rect.y + shift_.y(), scale_ * rect.width,
            scale_ * rect.height};
  }

  double scale_;
  Eigen::Vector2d shift_;
};

}  // namespace

PageArea wholePage(const std::array<double, 2>& size, const Color& color) {
  const auto [width, height] = size;
  return {{{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}, color};
}

PageSketch placed(PageSketch sketch, double scale, const Eigen::Vector2d& shift) {
  const Placement placement(scale, shift);
  for (PageSketch::Shape& shape : sketch.shapes) std::visit(placement, shape);
  return sketch;
}

std::vector<std::pair<PixelRect, Color>> overlapping(const PageStripes& stripes) {
  std::vector<std::pair<PixelRect, Color>> result;
  for (std::size_t k = 0; k < stripes.colors.size(); ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(stripes.colors.size());
    PixelRect rect = stripes.rect;
    if (stripes.direction == TextDirection::Right) {
      rect.x += part * rect.width;
      rect.width *= 1.0 - part;
    } else {
      rect.y += part * rect.height;
      rect.height *= 1.0 - part;
    }
    result.emplace_back(rect, stripes.colors[k]);
  }
  return result;
}

}  // namespace burnish
