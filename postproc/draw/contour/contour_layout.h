#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "postproc/draw/contour/scalar_bar.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"

namespace burnish {

/// Size of the ordinary text in a picture of this size, in pixels.
double textSizeFor(const std::array<int, 2>& pictureSize);

/// Where everything stands in a contour picture. Caption at the top left; the colour scale at the right or
/// below, where it leaves more room for the body.
struct ContourLayout {
  FittedText title;              ///< empty text: none
  FittedText time;               ///< empty text: none
  FittedText doubt;              ///< empty text: none
  std::vector<FittedText> note;  ///< its lines; two where one would be cut off
  Eigen::Vector2d titleAt, timeAt, doubtAt;
  Eigen::Vector2d noteAt;  ///< end (bar upright) or middle (bar across) of its first baseline
  double noteLine = 0.0;   ///< from its first baseline to the second
  PixelRect bar;           ///< of no size below the view without a colour scale
  Overlay::Direction barDirection;
  View view;
  Eigen::Vector2d
      scaleBarAt;  ///< lower left corner of the scale bar, of which there is room if the caption asks
  Eigen::Vector2d triadAt;  ///< lower left corner of the axes, of which there is room if the caption asks
  bool hasRoom = true;      ///< for the content and the numbers of its scale; else texts lie over one another
};

/// What stands above the body, and small below it and its colour scale; each may be empty. doubt: in the
/// lower left corner, below the note. triad: there is room for the axes at the lower left. scaleBar: for one beside
/// them.
struct ContourCaption {
  std::string title, time, note;
  std::string doubt{};
  bool triad = false;
  bool scaleBar = false;
  bool noteRoom = false, doubtRoom = false;  ///< as much room as for these texts, even without them
  Eigen::Vector2d axesRoom{0.0, 0.0};        ///< at the left of the content, and below it
};

/// textSize: of ordinary text, in pixels. content: the projected box that must be seen. axes: see `View`. bar:
/// null without a colour scale.
ContourLayout layOutContour(const std::array<int, 2>& pictureSize, double textSize,
                            const Eigen::AlignedBox2d& content, const Eigen::Matrix<double, 2, 3>& axes,
                            const ContourCaption& caption, const ScalarBar* bar, const Theme& theme);

}  // namespace burnish
