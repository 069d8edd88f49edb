#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/font.h"
#include "postproc/draw/page/rich_text.h"
#include "postproc/draw/page/view.h"

class vtkRenderer;

namespace burnish {

struct TextStyle {
  double size = 12.0;  ///< height of the font in pixels of the picture
  Color color{0, 0, 0};
  std::string font = kDefaultFont;  ///< see `fontNamed`
};

/// Length of a line of text in pixels of the picture.
double textWidth(const RichText& text, const TextStyle& style);

/// The text with a smaller size, not below `smallest`, or cut off with "…" so that it is not longer than
/// `width`.
struct FittedText {
  RichText text;
  TextStyle style;
};
FittedText fitText(RichText text, TextStyle style, double width, double smallest);

/// Height of the digits and capitals, in pixels.
double capitalHeight(const TextStyle& style);
double capitalHeight(double size);  ///< in the default font

/// What is drawn over a picture in pixels (see PixelRect), in a renderer that is `scale` times larger.
class Overlay {
 public:
  enum class Anchor { Start, Middle, End };
  enum class Direction { Right, Up };

  Overlay(vtkRenderer& renderer, int scale) : renderer_(renderer), scale_(scale) {}

  /// `at`: the start, the middle or the end of the text's baseline.
  void addText(const RichText& text, const Eigen::Vector2d& at, const TextStyle& style,
               Anchor anchor = Anchor::Start, Direction direction = Direction::Right);

  /// Line segments from even to odd points.
  void addSegments(const std::vector<Eigen::Vector2d>& points, double width, const Color& color);

  /// A rectangle in stripes of these colours, from left to right or from bottom to top.
  void addStripes(const PixelRect& rect, const std::vector<Color>& colors, Direction direction);

 private:
  void addPiece(const FontPiece& piece, const Eigen::Vector2d& baseline, const TextStyle& style,
                Direction direction);

  vtkRenderer& renderer_;
  int scale_;
};

}  // namespace burnish
