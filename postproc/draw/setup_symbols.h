#pragma once
#include <string>

#include "postproc/draw/flat_shapes.h"
#include "postproc/draw/overlay.h"

namespace burnish {

/// The symbols of a mechanical drawing, in pixels, black on white; sizes follow from the text size.
class SetupSymbols {
 public:
  using Points = FlatShapes::Points;

  /// Depth that supports, rows of arrows and dimension lines take beside the body, in text sizes.
  static constexpr double kSupportDepth = 1.1, kLoadDepth = 3.4, kDimensionDepth = 2.6;

  SetupSymbols(vtkRenderer& renderer, int scale, double textSize);

  double textSize() const { return text_.size; }

  /// Slanted strokes along a line, on the side to which `outward` (one unit vector per point) points.
  void addHatching(const Points& line, const Points& outward);

  /// Circles between a line and a hatched one.
  void addRollers(const Points& line, const Points& outward);

  void addArrow(const Eigen::Vector2d& tail, const Eigen::Vector2d& tip);

  /// Arrows in a direction (unit vector) spread over a line: tips on it if they push against the outward
  /// normals, else tails.
  void addLoad(const Points& line, const Points& outward, const Eigen::Vector2d& direction,
               const std::string& label);

  /// A dimension line from `begin` to `end`, moved by `offset` from the two points that it measures.
  void addDimension(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, const Eigen::Vector2d& offset,
                    const std::string& label);

  /// A radius with its arrow head at `rim` and the text outside of it.
  void addRadius(const Eigen::Vector2d& center, const Eigen::Vector2d& rim, const std::string& label);

  /// Two small axes.
  void addAxes(const Eigen::Vector2d& origin);

  void addDashes(const Points& line);

  /// Text whose middle lies at a point, or whose start or end does.
  void addText(const RichText& text, const Eigen::Vector2d& middle,
               Overlay::Anchor anchor = Overlay::Anchor::Middle,
               Overlay::Direction direction = Overlay::Direction::Right);

 private:
  void addHead(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction);

  FlatShapes shapes_;
  Overlay overlay_;
  TextStyle text_;
  double thin_, thick_;
};

}  // namespace burnish
