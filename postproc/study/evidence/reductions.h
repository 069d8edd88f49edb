#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/history.h"
#include "postproc/study/evidence/quantity.h"

/// Numbers from curves. None of them has a value where the curve does not show it.
namespace burnish {

/// Points of a curve y(x), as many x as y, all finite.
struct Series {
  std::vector<double> x, y;
};

/// y over x for the rows in which `where` is not zero and both are finite; all three are expressions.
Series seriesOf(const HistoryTable& history, const std::string& x, const std::string& y,
                const std::string& where);

/// The points with x in the range, up to rounding.
Series restricted(const Series& series, const std::array<double, 2>& range);

/// Whether x comes to the end of the range, up to rounding.
bool reachesEnd(const Series& series, const std::array<double, 2>& range);

/// Linear interpolation between the first two consecutive points that x lies between.
std::optional<double> interpolate(const Series& series, double x);

/// Mean of y over x: the integral by the trapezoidal rule over the length; of a single point its value.
std::optional<double> meanOver(const Series& series);

/// Root mean square of what is left of y without its least-squares quartic in x; from 6 points on.
std::optional<double> oscillation(const Series& series);

/// A curve of one point or more reduced to a number; `at`, which needs an x, has none.
std::optional<double> reduced(const Series& series, Reduction reduction);

/// Largest |a - b| of two curves at the x that both have.
std::optional<double> largestDifference(const Series& a, const Series& b);

/// The first x at which |a - b| exceeds the tolerance.
std::optional<double> firstDeparture(const Series& a, const Series& b, double tolerance);

/// Sum of |y_{k+1} - y_k|.
double variation(const Eigen::VectorXd& y);

/// The order log(r_{k+1}/r_k) / log(r_k/r_{k-1}) of the last three residuals above rounding (1e-12).
std::optional<double> convergenceOrder(const std::vector<double>& residuals);

/// Median; of an even number of values the mean of the two in the middle.
std::optional<double> median(std::vector<double> values);

}  // namespace burnish
