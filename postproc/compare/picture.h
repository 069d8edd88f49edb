#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"

namespace burnish {

/// A picture of RGB bytes in sRGB; pixels are counted from the lower left corner.
struct Picture {
  int width = 0, height = 0;
  std::vector<Color> pixels;  ///< lowest row first

  /// The pixel around a position, or the nearest one for positions outside.
  const Color& at(const Eigen::Vector2d& position) const;
};

/// Reads a PNG of any kind: grey and palette become RGB, 16 bits per channel 8, and what is translucent
/// stands on white. Throws `Error` naming the file if it is missing, no PNG, damaged, or above 2^28 pixels.
Picture readPicture(const std::filesystem::path& png);

/// The bytes of a PNG file.
std::string encodePng(const Picture& picture);

}  // namespace burnish
