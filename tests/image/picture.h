#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "postproc/draw/color_scale.h"

namespace burnish {

/// A picture of RGB bytes; pixels are counted from the lower left corner.
struct Picture {
  int width = 0, height = 0;
  std::vector<Color> pixels;  ///< lowest row first

  const Color& at(const Eigen::Vector2d& position) const;
};

/// Throws `Error` if the file is missing or no PNG of RGB bytes.
Picture readPicture(const std::filesystem::path& png);

/// Largest difference of a channel.
int difference(const Color& a, const Color& b);

/// Share of pixels that differ by more than 8 of 255 in a channel; 1 for pictures of different sizes.
double differentShare(const Picture& a, const Picture& b);

/// Share of pixels that differ from the one in the corner; 0 for a blank picture.
double drawnShare(const Picture& picture);

/// Pictures with a smaller share of different pixels count as equal: 120 pixels of 400 x 300.
inline constexpr double kAllowedShare = 0.001;

/// Compares a picture with images/baseline/NAME.png; with BURNISH_WRITE_BASELINES in the environment writes
/// that file instead, and fails all the same, because a person is to look at it.
void expectBaseline(const std::filesystem::path& drawn, const std::string& name);

}  // namespace burnish
