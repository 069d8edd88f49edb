#pragma once
#include <array>

#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/draw/page/color_scale.h"

namespace burnish {

/// The colours of a field whose values go over `shown`: those of the options, in a range that colours can have;
/// about zero where signs mean something and both occur.
ColorScale colorScaleOf(const FieldChoice& field, const PictureOptions& options,
                        const std::array<double, 2>& shown);

}  // namespace burnish
