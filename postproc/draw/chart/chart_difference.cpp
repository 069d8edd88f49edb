#include "postproc/draw/chart/chart_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr double kReferenceSlack = 1e-9;  ///< round-off at the ends of the reference, part of its length

/// The points whose x is a number.
ChartCurve withX(const ChartCurve& curve) {
  ChartCurve kept{curve.label, {}, {}, curve.style, curve.onRight};
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!std::isfinite(curve.x[k])) continue;
    kept.x.push_back(curve.x[k]);
    kept.y.push_back(curve.y[k]);
  }
  return kept;
}

void checkMonotone(const ChartCurve& curve) {
  for (std::size_t k = 1; k < curve.x.size(); ++k) {
    const double step = curve.x[k] - curve.x[k - 1];
    if (step != 0.0 && (step > 0.0) == (curve.x[1] > curve.x[0])) continue;
    throw Error(fmt::format(
        "{}: x goes from {} to {} at point {}; a difference needs an x that only grows or only falls",
        curve.label, curve.x[k - 1], curve.x[k], k + 1));
  }
}

/// A curve whose x grows, to be asked for y in between.
class Interpolant {
 public:
  explicit Interpolant(ChartCurve curve) : curve_(std::move(curve)) {
    if (curve_.x.size() < 2 || curve_.x.front() < curve_.x.back()) return;
    std::reverse(curve_.x.begin(), curve_.x.end());
    std::reverse(curve_.y.begin(), curve_.y.end());
  }

  /// Not finite where there is no value.
  double at(double x) const {
    const std::vector<double>& xs = curve_.x;
    if (xs.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double slack = kReferenceSlack * (xs.back() - xs.front());
    if (x < xs.front() - slack || x > xs.back() + slack) return std::numeric_limits<double>::quiet_NaN();
    const double inside = std::clamp(x, xs.front(), xs.back());
    const auto next = static_cast<std::size_t>(std::lower_bound(xs.begin(), xs.end(), inside) - xs.begin());
    if (xs[next] == inside) return curve_.y[next];  // a neighbour without a value does not matter
    const double share = (inside - xs[next - 1]) / (xs[next] - xs[next - 1]);
    return (1.0 - share) * curve_.y[next - 1] + share * curve_.y[next];
  }

  double largestMagnitude() const {
    double largest = 0.0;
    for (const double y : curve_.y)
      if (std::isfinite(y)) largest = std::max(largest, std::abs(y));
    return largest;
  }

 private:
  ChartCurve curve_;
};

}  // namespace

CurveDifference differenceOf(const ChartCurve& curve, const ChartCurve& reference, DifferenceKind kind) {
  const ChartCurve points = withX(curve), from = withX(reference);
  checkMonotone(points);
  checkMonotone(from);
  const Interpolant interpolant(from);
  CurveDifference result{
      {curve.label, {}, {}, curve.style, curve.onRight}, -1.0, 0.0, interpolant.largestMagnitude()};
  const double unit = kind == DifferenceKind::Relative ? result.referenceMagnitude : 1.0;
  if (unit == 0.0)
    throw Error(
        fmt::format("{}: all values are 0; there is no relative difference from them", reference.label));
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    const double difference = points.y[k] - interpolant.at(points.x[k]);
    if (!std::isfinite(difference)) continue;
    result.curve.x.push_back(points.x[k]);
    result.curve.y.push_back(difference / unit);
    if (std::abs(difference) <= result.largest) continue;
    result.largest = std::abs(difference);
    result.largestAt = points.x[k];
  }
  if (result.curve.x.empty())
    throw Error(fmt::format("{}: no x at which {} has a value too", curve.label, reference.label));
  return result;
}

}  // namespace burnish
