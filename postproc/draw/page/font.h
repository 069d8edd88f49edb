#pragma once
#include <string>
#include <vector>

#include "postproc/draw/page/shaped_text.h"

namespace burnish {

/// Has Greek letters, overbars and superscripts.
inline constexpr const char* kDefaultFont = "DejaVu Sans";

/// A scalable font, and what laying out its texts must know: parts of the font size.
struct Font {
  std::string file;
  std::string family;
  double capitals = 0.0;  ///< height of the capitals
  double descent = 0.0;   ///< how far letters reach below the line
};

/// Whether a name is that of a file: with a slash or an ending of fonts.
bool isFontFile(const std::string& name);

/// A family that is installed, or a file. Throws `Error` with the nearest family, and for a file that is
/// missing or holds no scalable font.
const Font& fontNamed(const std::string& name);

/// A part of a text and the font that has its letters.
struct FontPiece {
  std::string text;  ///< as it is drawn, from left to right
  const Font* font;
  std::string letters;  ///< as it was written; those of all pieces are the text
  ShapedText shaped{};  ///< has glyphs if they are not those of one letter after the other
  /// Of a text from right to left, for each letter of `text` the one that was written, or the two: Arabic letters are drawn by
  /// others, those of their forms.
  std::vector<std::string> meant{};
};

/// Whether it is painted by its glyphs.
inline bool isShaped(const FontPiece& piece) {
  return !piece.shaped.glyphs.empty();
}

/// Whether a text has letters of scripts from right to left.
bool hasLettersFromRightToLeft(const std::string& text);

/// The text in one line, in parts: what the font of this name has not, such as Greek letters, is in the
/// default font, or in another one that is installed; a letter that none has becomes a box. Scripts from right to left have the order
/// and the forms in which they are read (Unicode's bidirectional algorithm), and those of South and Southeast Asia the glyphs that the
/// font has for letters beside one another.
std::vector<FontPiece> fontPieces(const std::string& text, const std::string& name);

/// To be told of every text that is drawn: one with a box is worth a warning (`noteWarning`), with the letters and the
/// font, and so is one of a script whose letters change their forms beside one another if no font has all of them.
void noteDrawnText(const std::string& text, const std::string& name);

}  // namespace burnish
