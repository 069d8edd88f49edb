#pragma once
#include <vector>

namespace burnish::inline rezoning {

/// A part of a face, by arc length from the begin of the face.
struct ArcInterval {
  double begin = 0.0;
  double end = 0.0;
};

/// How fast knot spans grow away from where they are finest: size h(d) = h_0 + slope (√(d² + δ²) − δ) at the
/// distance d, with δ = `rounding`, a length.
struct SpanGrowth {
  double slope = 0.25;
  double rounding = 0.0;
};

/// Breakpoints of knot spans.
struct SpanDistribution {
  std::vector<double> breakpoints;  ///< from 0 to 1, shares of the length
  double finest = 0.0;              ///< h_0, a length
  double smallest = 0.0;            ///< length of the smallest span, less than h_0 where a limit wants that
};

/// Divides a length into knot spans that are finest in an interval of it. limits: the largest sizes that are
/// wanted at evenly spaced places from 0 to the length, with the same growth around them; spans are not made
/// smaller than h_0 for them, in the interval than h_0 / 2. None when empty. Throws `Error` unless the length
/// is positive and there is at least one span.
SpanDistribution distributeSpans(double length, const ArcInterval& finest, int numSpans,
                                 const SpanGrowth& growth, const std::vector<double>& limits = {});

/// Divides a depth into knot spans that begin with the size `first` and grow by a constant ratio; equal ones
/// where the first size times their number already fills the depth. From 0 to 1, the first at 0.
std::vector<double> distributeLayers(double depth, double first, int numSpans);

}  // namespace burnish::inline rezoning
