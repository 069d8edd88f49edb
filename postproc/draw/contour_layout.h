#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>

#include "postproc/draw/overlay.h"
#include "postproc/draw/scalar_bar.h"
#include "postproc/draw/view.h"

namespace burnish {

/// Size of the ordinary text in a picture of this size, in pixels.
double textSizeFor(const std::array<int, 2>& pictureSize);

/// Where everything stands in a contour picture. Caption at the top left; the colour scale at the right or
/// below, where it leaves more room for the body.
struct ContourLayout {
  FittedText title;  ///< empty text: none
  Eigen::Vector2d titleAt, timeAt;
  TextStyle timeStyle;
  PixelRect bar;
  Overlay::Direction barDirection;
  View view;
};

/// content: the projected box that must be seen. axes: see `View`.
ContourLayout layOutContour(const std::array<int, 2>& pictureSize, const Eigen::AlignedBox2d& content,
                            const Eigen::Matrix<double, 2, 3>& axes, const std::string& title,
                            const ScalarBar& bar);

}  // namespace burnish
