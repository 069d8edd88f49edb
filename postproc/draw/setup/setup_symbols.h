#pragma once
#include <array>
#include <string>
#include <vector>

#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"

namespace burnish {

/// The symbols of a mechanical drawing, in pixels, black on white; sizes follow from the text size.
class SetupSymbols {
 public:
  using Points = FlatShapes::Points;

  static constexpr Color kInk{20, 20, 20};

  /// Depth that supports, rows of arrows, dimension lines take beside the body, in
  /// text sizes.
  static constexpr double kSupportDepth = 1.1, kLoadDepth = 3.4, kDimensionDepth = 2.6;

  /// Length that arrows of motions have at least, in text sizes.
  static constexpr double kShortestMotion = 2.2;

  /// size: of the picture, in which all texts of loads stay.
  SetupSymbols(PageSketch& sketch, const std::array<int, 2>& size, double textSize);

  double textSize() const { return text_.size; }

  /// Slanted strokes along a line, on the side to which `outward` (one unit vector per point) points.
  void addHatching(const Points& line, const Points& outward);

  /// Circles between a line and a hatched one.
  void addRollers(const Points& line, const Points& outward);

  void addArrow(const Eigen::Vector2d& tail, const Eigen::Vector2d& tip);

  /// Arrows spread over a line with a vector at each of its points; the longest vector has an arrow of full
  /// length. Tips on the line if they push against the outward normals, tails if they pull, beside it if they
  /// all go along it.
  void addLoad(const Points& line, const Points& outward, const Points& vectors, const std::string& label);

  /// One arrow with its middle at a point and its text before its tail.
  void addForce(const Eigen::Vector2d& middle, const Eigen::Vector2d& direction, const std::string& label);

  /// The same with its tip at the point.
  void addForceTo(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction, const std::string& label);

  /// Part of a circle with a head, and its text beyond the circle at the upper left.
  void addTurn(const Eigen::Vector2d& center, double radius, bool counterclockwise, const std::string& label);

  /// A dimension line from `begin` to `end`, moved by `offset` from the two points that it measures.
  void addDimension(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, const Eigen::Vector2d& offset,
                    const std::string& label);

  /// A radius with its arrow head at `rim` and the text outside of it.
  void addRadius(const Eigen::Vector2d& center, const Eigen::Vector2d& rim, const std::string& label);

  /// Two small axes.
  void addAxes(const Eigen::Vector2d& origin);

  void addDashes(const Points& line);

  /// A line of dashes and dots, such as an axis, with a text at the left of its end.
  void addAxisLine(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, const std::string& label);

  /// Text whose middle lies at a point, or whose start or end does.
  void addText(const RichText& text, const Eigen::Vector2d& middle,
               Overlay::Anchor anchor = Overlay::Anchor::Middle,
               Overlay::Direction direction = Overlay::Direction::Right);

  /// The same, standing back.
  void addFaintText(const std::string& text, const Eigen::Vector2d& middle);

 private:
  void addText(const RichText& text, const Eigen::Vector2d& middle, const TextStyle& style,
               Overlay::Anchor anchor, Overlay::Direction direction);
  void addLoadArrow(const Eigen::Vector2d& at, const Eigen::Vector2d& outward, const Eigen::Vector2d& vector,
                    bool isAlong);
  void addDashed(const Points& line, const std::vector<double>& pattern, const Color& color);
  /// Beyond arrows at a point of a line.
  void addLoadText(const std::string& label, const Eigen::Vector2d& at, const Eigen::Vector2d& outward);
  void addHead(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction);

  Eigen::Vector2d size_;
  FlatShapes shapes_;
  Overlay overlay_;
  TextStyle text_;
  double thin_, thick_;
};

}  // namespace burnish
