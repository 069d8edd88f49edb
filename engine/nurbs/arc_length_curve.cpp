#include "engine/nurbs/arc_length_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/nurbs/quadrature.h"

namespace burnish::inline nurbs {
namespace {

constexpr int kSamplesPerSpan = 8;
constexpr int kPoints = 6;  // of the quadrature between two samples
constexpr int kCorrections = 3;

/// Number of the sample interval that contains a value.
std::size_t intervalOf(const std::vector<double>& samples, double value) {
  const auto above = std::upper_bound(samples.begin(), samples.end(), value);
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - samples.begin() - 1, 0, std::ssize(samples) - 2));
}

}  // namespace

ArcLengthCurve::ArcLengthCurve(Patch<1, 2> curve) : curve_(std::move(curve)) {
  const auto& basis = curve_.basis().direction(0);
  parameters_.push_back(basis.spanBegin(0));
  lengths_.push_back(0.0);
  for (int e = 0; e < basis.numSpans(); ++e)
    for (int k = 1; k <= kSamplesPerSpan; ++k) {
      const double share = static_cast<double>(k) / kSamplesPerSpan;
      const double xi =
          k == kSamplesPerSpan ? basis.spanEnd(e) : std::lerp(basis.spanBegin(e), basis.spanEnd(e), share);
      lengths_.push_back(lengths_.back() + lengthBetween(parameters_.back(), xi));
      parameters_.push_back(xi);
    }
}

double ArcLengthCurve::lengthBetween(double begin, double end) const {
  static const QuadratureRule rule = gaussLegendre(kPoints);
  double length = 0.0;
  for (int k = 0; k < kPoints; ++k)
    length += rule.weights(k) * curve_.jacobian(parameter(std::lerp(begin, end, rule.points(k)))).norm();
  return length * (end - begin);
}

double ArcLengthCurve::parameterAt(double s) const {
  s = std::clamp(s, 0.0, length());
  const std::size_t k = intervalOf(lengths_, s);
  const double begin = parameters_[k], end = parameters_[k + 1];
  double xi = std::lerp(begin, end, (s - lengths_[k]) / (lengths_[k + 1] - lengths_[k]));
  for (int i = 0; i < kCorrections; ++i) {
    const double speed = curve_.jacobian(parameter(xi)).norm();
    if (speed == 0.0) break;
    xi = std::clamp(xi - (lengths_[k] + lengthBetween(begin, xi) - s) / speed, begin, end);
  }
  return xi;
}

double ArcLengthCurve::lengthTo(double xi) const {
  xi = std::clamp(xi, parameters_.front(), parameters_.back());
  const std::size_t k = intervalOf(parameters_, xi);
  return lengths_[k] + lengthBetween(parameters_[k], xi);
}

std::vector<double> ArcLengthCurve::curvatures(int places, double apart) const {
  std::vector<double> result;
  for (int k = 0; k < places; ++k) {
    const double s = length() * k / (places - 1);
    const double begin = std::clamp(s - 0.5 * apart, 0.0, length() - apart);
    result.push_back((tangentAt(begin + apart) - tangentAt(begin)).norm() / apart);
  }
  return result;
}

Eigen::Vector2d ArcLengthCurve::tangentAt(double s) const {
  return curve_.jacobian(parameter(parameterAt(s))).normalized();
}

}  // namespace burnish::inline nurbs
