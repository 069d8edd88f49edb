#pragma once
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"

namespace burnish {

/// Room that the axes take in a picture, as a part of the text size.
inline constexpr double kTriadRoom = 4.4;

/// Draws the directions of x, y and z in a view as arrows with their names, in the square of
/// `kTriadRoom` text sizes whose lower left corner is `corner`, in pixels. An axis along the view is left
/// out.
void drawAxesTriad(FlatShapes& shapes, Overlay& overlay, const ViewAxes& axes, const Eigen::Vector2d& corner,
                   double textSize, const Theme& theme);

}  // namespace burnish
