#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/flat_shapes.h"
#include "postproc/draw/page/overlay.h"
#include "postproc/draw/page/theme.h"
#include "postproc/text/ticks.h"

namespace burnish {

/// The colour scale with ticks and title; beyond its ends stand the smallest and the largest value of the
/// field. An end that values pass is an arrow with the value where the colours end (≥ 0.2). Bands have ticks at their
/// borders.
class ScalarBar {
 public:
  using Direction = Overlay::Direction;

  struct Texts {
    RichText title;
    std::string unit;          ///< may be empty
    double smallest, largest;  ///< values of the field; not numbers if it has none

    /// Of the values 0, 1, …, which stand beside the scale instead of round ones and the ends.
    std::vector<std::string> states{};

    /// The smallest and the largest value of each of the scales that stand together: there is room for the numbers of all.
    std::vector<std::array<double, 2>> together{};

    /// Whether to leave as much room for numbers as those of other ranges would take.
    bool even = false;

    /// Whether to leave room for arrows at the lower and the upper end, since values pass that of another range.
    std::array<bool, 2> arrows{};

    /// Whether the two values have the signs that mark their places.
    bool marked = false;

    int bands = 0;  ///< 0: smooth colours
    bool constant =
        false;  ///< the field has one value, round which the colours were laid: it alone has a tick, and
                ///< stands below the scale
    std::optional<Color> gaps{};  ///< the colour of places without values, of which a box tells
    bool gapsRoom = false;        ///< as much room as for this box, even without it
  };

  /// textSize: of the title, in pixels.
  ScalarBar(ColorScale scale, Texts texts, double textSize, const Theme& theme);

  /// Pixels it takes across when it is `length` pixels long, ends included.
  double depth(Direction direction, double length) const;

  /// Draws it into a space of that depth: labels and title at its right or its lower side. Both drawers must
  /// be of the same renderer.
  void draw(Overlay& overlay, FlatShapes& shapes, const PixelRect& space, Direction direction) const;

  /// What stands beside it, for those who draw it elsewhere: the title with its unit, the marks, and the
  /// smallest and largest value of the field (empty texts for states).
  const RichText& title() const { return title_; }
  Ticks marks() const { return ticks(kMostTicks); }
  const RichText& smallest() const { return low_.extreme; }
  const RichText& largest() const { return high_.extreme; }

 private:
  static constexpr int kMostTicks = 11;

  void drawUp(Overlay& overlay, FlatShapes& shapes, const PixelRect& space) const;
  void drawAcross(Overlay& overlay, FlatShapes& shapes, const PixelRect& space) const;
  void drawEndAcross(Overlay& overlay, const PixelRect& bar, bool high, double edge) const;
  void drawGaps(Overlay& overlay, FlatShapes& shapes, const Eigen::Vector2d& corner) const;
  void drawArrow(FlatShapes& shapes, const PixelRect& bar, Direction direction, bool high) const;
  void drawFrameAndTicks(Overlay& overlay, FlatShapes& shapes, const PixelRect& bar, Direction direction,
                         const Ticks& ticks) const;
  Ticks ticks(int most) const;

  /// At most so many marks with those ends of the scale that no other number tells, instead of marks next to them.
  Ticks withEnds(Ticks ticks, int most) const;
  Ticks ticksUp(double barLength) const;
  Ticks ticksAcross(double barLength) const;
  double barLengthUp(double length) const;
  double longestEnd() const;

  /// What the box of places without values takes, with the gap before it; 0 without one.
  double gapsHeight() const;
  double gapsWidth() const;

  /// The title in so many pixels: in smaller letters, or with a shorter name before its unit.
  FittedText fittedTitle(double length) const;

  /// Whether a title along the upright bar stands beside the texts at its ends.
  bool reachesEnds(const FittedText& title, double length) const;
  double endAcross(bool high) const;
  double longestLabel(const Ticks& ticks) const;
  double lineWidth() const;
  double along(double value) const;

  ColorScale scale_;
  RichText name_, unit_, title_;  ///< the title is name and unit
  std::vector<std::string> states_;

  /// What stands at an end.
  struct End {
    RichText extreme;  ///< of the field
    RichText limit;    ///< of the colours, if values pass it
    bool passed = false;
    bool isTold = false;  ///< the limit, by its text or that of the extreme
    bool hasArrow =
        false;  ///< room for one, since values pass the end in one of the scales that stand together
    double longest = 0.0;  ///< of the extremes of these, in pixels
  };
  End low_, high_;
  double size_;
  bool even_;
  int bands_;
  std::optional<double> constant_;  ///< the value of a field that has one
  std::optional<Color> gaps_;
  bool hasGapsRoom_;
  Color ink_;
  TextStyle titleStyle_, labelStyle_, endStyle_;
};

}  // namespace burnish
