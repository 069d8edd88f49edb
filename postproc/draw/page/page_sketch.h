#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/rich_text.h"
#include "postproc/draw/page/text_layout.h"
#include "postproc/draw/page/view.h"

class vtkImageData;

namespace burnish {

using PagePoints = std::vector<Eigen::Vector2d>;

/// Polylines that are painted at once.
struct PageLines {
  std::vector<PagePoints> lines;
  double width;
  Color color;
  double opacity = 1.0;
  bool round = false;                 ///< ends and corners; a line of one place is a dot then
  std::optional<PixelRect> within{};  ///< what lies outside is not seen
};

struct PageArea {
  PagePoints corners;  ///< of a polygon
  Color color;
  std::optional<PixelRect> within{};
};

/// What an odd number of closed lines surrounds.
struct PageRegion {
  std::vector<PagePoints> loops;
  Color color;
  std::optional<PixelRect> within{};
};

/// A rectangle in stripes of these colours, from left to right or from bottom to top.
struct PageStripes {
  PixelRect rect;
  std::vector<Color> colors;
  TextDirection direction;
};

/// The stripes one over the other, each from its begin to the end of all: painted in turn, nothing shines through
/// between two of them.
std::vector<std::pair<PixelRect, Color>> overlapping(const PageStripes& stripes);

struct PageText {
  RichText text;
  Eigen::Vector2d at;  ///< the start, the middle or the end of the baseline
  TextStyle style;
  TextAnchor anchor = TextAnchor::Start;
  TextDirection direction = TextDirection::Right;
};

/// A picture of pixels, RGB or RGBA, lowest row first.
struct PageImage {
  PixelRect rect;
  vtkSmartPointer<vtkImageData> pixels;
};

/// What is drawn flat on a page, in the order in which it is painted, later over earlier; all lengths in pixels
/// of the picture (see PixelRect). It becomes pixels
/// (`paint`) or a file for print (`writePrint`).
struct PageSketch {
  using Shape = std::variant<PageLines, PageArea, PageRegion, PageStripes, PageText, PageImage>;
  std::vector<Shape> shapes;
};

/// All of a page in one colour.
PageArea wholePage(const std::array<double, 2>& size, const Color& color);

/// The sketch where it stands on another page: all of it scaled, then moved.
PageSketch placed(PageSketch sketch, double scale, const Eigen::Vector2d& shift);

}  // namespace burnish
