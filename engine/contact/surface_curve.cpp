#include "engine/contact/surface_curve.h"

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

constexpr int kMaxSteps = 50;

/// Angle between the normal and the way to the position at which a point counts as nearest, and the last
/// step in parts of the range of parameters at which the search stops: rounding.
constexpr double kAngle = 1e-12;
constexpr double kStep = 1e-15;

}  // namespace

SurfaceCurve::Point SurfaceCurve::at(double xi) const {
  const UnivariateBasis& basis = curve_.basis().direction(0);
  const int span = basis.findSpan(xi);
  Point point;
  point.xi = xi;
  point.functions = curve_.basis().spanFunctions(span);
  const auto w = curve_.weights()(point.functions);
  const Eigen::MatrixXd N = (basis.evaluate(span, xi, 2).array().colwise() * w.array()).matrix();
  const Eigen::RowVector3d W = N.colwise().sum();
  point.R = N.col(0) / W(0);
  point.dR = (N.col(1) - W(1) * point.R) / W(0);
  const Eigen::VectorXd ddR = (N.col(2) - 2.0 * W(1) * point.dR - W(2) * point.R) / W(0);
  const Eigen::Matrix2Xd points = curve_.points()(Eigen::all, point.functions);
  point.x = points * point.R;
  point.dx = points * point.dR;
  point.ddx = points * ddR;
  point.normal = outward_ * Eigen::Vector2d(point.dx(1), -point.dx(0)).normalized();
  return point;
}

std::optional<SurfaceCurve::Point> SurfaceCurve::nearest(const Eigen::Vector2d& position,
                                                         double start) const {
  const UnivariateBasis& basis = curve_.basis().direction(0);
  const int last = basis.numSpans() - 1;
  const double begin = 2.0 * basis.spanBegin(0) - basis.spanEnd(0),
               end = 2.0 * basis.spanEnd(last) - basis.spanBegin(last);
  double xi = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    Point point = at(xi);
    const Eigen::Vector2d way = position - point.x;
    const double residual = way.dot(point.dx), square = point.dx.squaredNorm();
    if (std::abs(residual) <= kAngle * std::sqrt(square) * way.norm()) return point;
    const double slope = square - way.dot(point.ddx);
    const double next = std::clamp(xi + residual / (slope > 0.0 ? slope : square), begin, end);
    if (next == xi && (xi == begin || xi == end)) return std::nullopt;
    if (std::abs(next - xi) <= kStep * (end - begin)) return at(next);
    xi = next;
  }
  return std::nullopt;
}

}  // namespace burnish
