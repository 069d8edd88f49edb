#pragma once
#include "postproc/draw/chart/chart.h"

namespace burnish {

enum class DifferenceKind { Absolute, Relative };

struct CurveDifference {
  ChartCurve curve;                 ///< y - y of the reference, where both have a value
  double largest = 0.0;             ///< of the magnitudes of y - y of the reference
  double largestAt = 0.0;           ///< x there
  double referenceMagnitude = 0.0;  ///< largest |y| of the reference
};

/// The difference of a curve from a reference, which is interpolated linearly at the curve's x; Relative:
/// divided by the largest |y| of the reference. Throws `Error` if an x neither only grows nor only falls, if
/// the curves have no x in common, and for a relative difference from 0.
CurveDifference differenceOf(const ChartCurve& curve, const ChartCurve& reference, DifferenceKind kind);

}  // namespace burnish
