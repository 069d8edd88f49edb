#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

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

/// Without glyphs if the font has none for a part of the text. Throws `ModuleError` if what shapes is not there.
ShapedText shapedText(const std::string& text, const std::string& fontFile);

/// The bytes of a font file with these letters alone, and the glyphs that they have beside one another; empty if the font has none of them, or
/// cannot be taken apart. Throws `ModuleError` as above.
std::string fontOfLetters(const std::set<char32_t>& letters, const std::string& fontFile);

}  // namespace burnish
