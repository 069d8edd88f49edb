#pragma once
#include <Eigen/Dense>

#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/univariate_basis.h"

namespace burnish::inline rezoning {

/// A curve on a new basis.
struct FittedCurve {
  Eigen::MatrixXd points;    ///< 2 x functions
  double normalError = 0.0;  ///< largest distance from the curve along its normal
};

/// Least-squares fit, in the arc length, of a curve to polynomial functions whose parameters on [0, 1] are
/// shares of the arc length; the ends are interpolated.
FittedCurve fitCurve(const ArcLengthCurve& curve, const UnivariateBasis& basis);

}  // namespace burnish::inline rezoning
