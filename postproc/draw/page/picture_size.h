#pragma once
#include <array>
#include <string>

/// The sizes that pictures may have: contour pictures, charts and drawings of the setup alike.
namespace burnish {

inline constexpr std::array<int, 2> kSmallestPicture{200, 150};  ///< width and height in pixels
inline constexpr int kLargestSide = 8000;

/// Whether a picture can have this width and height.
bool isPictureSize(const std::array<int, 2>& size);

/// "200 x 150 to 8000 x 8000".
std::string pictureSizeWords();

}  // namespace burnish
