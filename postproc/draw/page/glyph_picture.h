#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <string>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/shaped_text.h"

class vtkImageData;

namespace burnish {

/// Pixels of one colour and any opacity that show glyphs, lowest row first.
struct GlyphPicture {
  vtkSmartPointer<vtkImageData> pixels;
  Eigen::Vector2d corner;  ///< its lower left one, from the start of the baseline; whole pixels
};

/// size: height of the font in pixels. upwards: turned to the left, along a line that goes up. What goes beyond the longest
/// side of a picture is cut off.
GlyphPicture glyphPicture(const ShapedText& text, const std::string& fontFile, int size, const Color& color,
                          bool upwards);

}  // namespace burnish
