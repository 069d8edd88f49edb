#pragma once
#include <string>

#include "postproc/draw/color_scale.h"
#include "postproc/draw/overlay.h"
#include "postproc/draw/ticks.h"

namespace burnish {

/// The colour scale with ticks and title; beyond its ends stand the smallest and the largest value of the
/// field.
class ScalarBar {
 public:
  struct Texts {
    RichText title;
    std::string unit;          ///< may be empty
    double smallest, largest;  ///< values of the field
  };

  /// textSize: of the title, in pixels.
  ScalarBar(ColorScale scale, Texts texts, double textSize);

  /// Pixels it takes across when it is `length` pixels long, ends included.
  double depth(Overlay::Direction direction, double length) const;

  /// Draws it into a space of that depth: labels and title at its right or its lower side.
  void draw(Overlay& overlay, const PixelRect& space, Overlay::Direction direction) const;

 private:
  void drawUp(Overlay& overlay, const PixelRect& space) const;
  void drawAcross(Overlay& overlay, const PixelRect& space) const;
  void drawFrameAndTicks(Overlay& overlay, const PixelRect& bar, Overlay::Direction direction,
                         const Ticks& ticks) const;
  Ticks ticksUp(double barLength) const;
  Ticks ticksAcross(double barLength) const;
  double barLengthUp(double length) const;
  double longestLabel(const Ticks& ticks) const;
  double along(double value) const;

  ColorScale scale_;
  RichText title_;
  RichText smallest_, largest_;
  double size_;
  TextStyle titleStyle_, labelStyle_, endStyle_;
};

}  // namespace burnish
