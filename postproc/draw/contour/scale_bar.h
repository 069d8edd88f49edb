#pragma once
#include <string>

#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/theme.h"
#include "postproc/draw/page/view.h"

namespace burnish {

/// The longest of 1, 2 and 5 times a power of ten that is not above `most` (> 0).
double roundLength(double most);

/// Height of the room that a scale bar takes, as a part of the text size.
inline constexpr double kScaleBarRoom = 1.6;

/// Draws a line as long as a round length in the plane of a view, about a fifth of what is seen, with its length in
/// words behind it. corner: lower left one of its room. unit: of lengths; may be empty.
void drawScaleBar(FlatShapes& shapes, Overlay& overlay, const View& view, const Eigen::Vector2d& corner,
                  const std::string& unit, double textSize, const Theme& theme);

}  // namespace burnish
