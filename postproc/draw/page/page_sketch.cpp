#include "postproc/draw/page/page_sketch.h"

#include <cstddef>

namespace burnish {

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
