#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/font.h"
#include "postproc/draw/page/rich_text.h"

namespace burnish {

struct TextStyle {
  double size = 12.0;  ///< height of the font in pixels of the picture
  Color color{0, 0, 0};
  std::string font = kDefaultFont;  ///< see `fontNamed`
};

enum class TextAnchor { Start, Middle, End };
enum class TextDirection { Right, Up };

/// Unit vector along a line of text.
Eigen::Vector2d unitAlong(TextDirection direction);

/// The part of a text's length that lies before its anchor.
double shareBefore(TextAnchor anchor);

/// A part of a line of text that is in one font, of one size and at one height.
struct TextPiece {
  FontPiece piece;
  double size;  ///< in pixels of the picture
  double lift;  ///< of its baseline over that of the line
};
std::vector<TextPiece> textPieces(const RichText& text, const TextStyle& style);

/// Distance from the start of a piece to the start of what follows it, blanks at its ends included.
double advance(const TextPiece& piece);

/// Fonts have whole sizes where they become pixels; text is measured and drawn with the same. scale: pixels of
/// the drawing per pixel of the picture.
int fontSize(double size, double scale);

/// Length of a line of text in pixels of the picture.
double textWidth(const RichText& text, const TextStyle& style);

/// The text with a smaller size, not below `smallest`, or cut off with "…" so that it is not longer than
/// `width`.
struct FittedText {
  RichText text;
  TextStyle style;
};
FittedText fitText(RichText text, TextStyle style, double width, double smallest);

/// The same of a name with what must stay behind it, such as its unit: the name alone is cut off, unless there is no room
/// for a letter of it.
FittedText fitName(const RichText& name, const RichText& unit, const TextStyle& style, double width,
                   double smallest);

/// Height of the digits and capitals, in pixels.
double capitalHeight(const TextStyle& style);
double capitalHeight(double size);  ///< in the default font

}  // namespace burnish
