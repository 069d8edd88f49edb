#pragma once
#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <vector>

#include "postproc/draw/chart/chart.h"
#include "postproc/draw/page/color_scale.h"
#include "postproc/draw/page/view.h"

namespace burnish {

using Polyline = std::vector<Eigen::Vector2d>;

/// The colour of a style: distinct for colour-blind people, neighbours also by their brightness in grey. On
/// dark paper, the theme's ink stands for black.
Color curveColor(const CurveStyle& style, const Theme& theme = {});

/// Lengths of a dash, a gap, a dash, …, in line widths; empty for a solid line.
const std::vector<double>& dashPattern(const CurveStyle& style);

/// The outline of a marker with the given half width around the origin.
Polyline markerOutline(const CurveStyle& style, double halfWidth);

/// A marker is filled, or a ring with white inside.
bool markerIsFilled(const CurveStyle& style);

/// The style of a curve that has none: all that tells curves apart changes with its number, so that twelve
/// have different pairs of dashes and markers.
CurveStyle defaultStyle(const Chart& chart, std::size_t number);

/// A curve in pixels.
struct PlottedCurve {
  CurveStyle style;
  std::vector<Polyline> pieces;  ///< what lies in the plot; a piece of one point is a lone point
  Polyline markers;              ///< centres, at points of the data: all of them, or some when there are many
};

/// The place in pixels of a pair of values; onRight: y is one of the axis at the right.
using PixelOf = std::function<Eigen::Vector2d(double x, double y, bool onRight)>;

/// The curves of a chart in the plot, a rectangle of pixels. Of more points than pixels can show, those that
/// make the same picture are left.
std::vector<PlottedCurve> plotCurves(const Chart& chart, const PixelRect& plot, const PixelOf& pixel);

/// The part of a segment that lies in a rectangle, or nothing.
std::optional<std::array<Eigen::Vector2d, 2>> clipSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                                          const PixelRect& rect);

/// The dashes of a line. pattern: lengths in pixels of dash, gap, …; start: where in it the line begins.
std::vector<Polyline> dashes(const Polyline& line, const std::vector<double>& pattern, double start);

}  // namespace burnish
