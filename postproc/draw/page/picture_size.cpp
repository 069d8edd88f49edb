#include "postproc/draw/page/picture_size.h"

#include <fmt/format.h>

#include <algorithm>

namespace burnish {

bool isPictureSize(const std::array<int, 2>& size) {
  return size[0] >= kSmallestPicture[0] && size[1] >= kSmallestPicture[1] &&
         std::max(size[0], size[1]) <= kLargestSide;
}

std::string pictureSizeWords() {
  return fmt::format("{} x {} to {} x {}", kSmallestPicture[0], kSmallestPicture[1], kLargestSide,
                     kLargestSide);
}

}  // namespace burnish
