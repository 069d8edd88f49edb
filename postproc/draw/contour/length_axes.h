#pragma once
#include <Eigen/Geometry>
#include <string>

#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"

namespace burnish {

/// What axes of lengths take at the left of a plane map, and below it, in pixels.
Eigen::Vector2d lengthAxesRoom(double textSize, const Theme& theme);

/// Round a box of the picture's plane a frame with ticks, numbers and titles: lengths from its lower left corner on. unit:
/// may be empty.
void drawLengthAxes(FlatShapes& shapes, Overlay& overlay, const View& view, const Eigen::AlignedBox2d& box,
                    const std::string& unit, double textSize, const Theme& theme);

}  // namespace burnish
