#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <cstddef>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"

class vtkImageData;

namespace burnish {

struct Glyph {
  unsigned index;      ///< in the font file
  Eigen::Vector2d at;  ///< from the start of the text's baseline, parts of the font size
  std::size_t letter;  ///< first byte of the letters that it stands for, alone or with its neighbours
};

/// A text of a script whose letters join beside one another and change their order, as a font sets it, from left
/// to right.
struct ShapedText {
  std::vector<Glyph> glyphs;
  double length = 0.0;  ///< part of the font size
};

/// Without glyphs if the font has none for a part of the text.
ShapedText shapedText(const std::string& text, const std::string& fontFile);

/// Pixels of one colour and any opacity that show glyphs, lowest row first.
struct GlyphPicture {
  vtkSmartPointer<vtkImageData> pixels;
  Eigen::Vector2d corner;  ///< its lower left one, from the start of the baseline; whole pixels
};

/// size: height of the font in pixels. upwards: turned to the left, along a line that goes up.
GlyphPicture glyphPicture(const ShapedText& text, const std::string& fontFile, int size, const Color& color,
                          bool upwards);

}  // namespace burnish
