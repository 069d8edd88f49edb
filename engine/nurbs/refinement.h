#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// Matrix T (functions of `fine` x functions of `coarse`) such that coefficients c of the coarse spline space
/// and T c of the fine one describe the same function. `fine` may have a higher degree, more knots, or both.
/// Throws `Error` if the coarse space is not contained in the fine one.
Eigen::MatrixXd refinementMatrix(const KnotVector& coarse, const KnotVector& fine);

/// Coefficients of a tensor product transformed by T along one direction. values: one row per function, the first
/// direction fastest; stride: number of functions in the directions before this one.
Eigen::MatrixXd appliedAlong(const Eigen::MatrixXd& values, const Eigen::MatrixXd& T, Eigen::Index stride);

/// The knot vector with knots added (values inside its domain; a value may be repeated).
KnotVector withKnots(const KnotVector& knots, const std::vector<double>& added);

/// The knot vector of degree p + `times`, continuity at every breakpoint unchanged.
KnotVector elevated(const KnotVector& knots, int times);

/// The knot vector with every span [a, b] divided at a + s (b - a), for each of the fractions s in (0, 1).
KnotVector divided(const KnotVector& knots, const std::vector<double>& fractions);

/// The knot vector with continuity C^0 only at the given places, s in [0, 1] from the begin to the end of its
/// domain. A place closer to a breakpoint than a thousandth of a span means this breakpoint.
KnotVector creased(const KnotVector& knots, const std::vector<double>& places);

/// The same geometry on finer B-spline bases, one knot vector per direction. Throws `Error` if a direction is
/// not a B-spline or its space is not contained in the new one.
template <int P, int S>
Patch<P, S> refined(const Patch<P, S>& patch, const std::vector<KnotVector>& target);

/// The patch on C^0 Lagrange bases of the given degree whose nodes lie on the geometry; weights are 1, so
/// curved geometry is interpolated, not exact. `breakpoints`: one list per direction, in the patch's own
/// parameters.
template <int P, int S>
Patch<P, S> lagrangeInterpolant(const Patch<P, S>& patch, int degree,
                                const std::vector<std::vector<double>>& breakpoints);

}  // namespace burnish::inline nurbs
