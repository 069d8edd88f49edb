#pragma once
#include <algorithm>
#include <random>

#include "postproc/compare/picture.h"

/// Changes of pictures that a comparison is to overlook or to notice.
namespace burnish {

/// 1 % of the pixels changed by 2 of 255, up or down, in every channel: nobody sees it.
inline Picture withNoise(Picture picture) {
  std::mt19937 random(1);
  for (Color& color : picture.pixels) {
    if (random() % 100 != 0) continue;
    for (unsigned char& channel : color)
      channel = static_cast<unsigned char>(std::clamp(channel + (random() % 2 == 0 ? 2 : -2), 0, 255));
  }
  return picture;
}

/// A mark of 6 x 20 pixels with its lower left corner at (i, j).
inline Picture withMark(Picture picture, int i, int j, const Color& color) {
  for (int y = j; y < j + 20; ++y)
    for (int x = i; x < i + 6; ++x) picture.pixels[static_cast<std::size_t>(y * picture.width + x)] = color;
  return picture;
}

/// A line of one pixel's width and a third of the picture's height, from (i, height / 3) up.
inline Picture withLine(Picture picture, int i, const Color& color) {
  for (int y = picture.height / 3; y < 2 * picture.height / 3; ++y)
    picture.pixels[static_cast<std::size_t>(y * picture.width + i)] = color;
  return picture;
}

}  // namespace burnish
