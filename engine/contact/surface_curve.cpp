#include "engine/contact/surface_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burnish {
namespace {

constexpr int kMaxSteps = 50;

/// Angle between the normal and the way to the position at which a point counts as the closest, and the
/// rounding errors of the coordinates that the last step may be long: what double precision allows.
constexpr double kAngle = 1e-12;
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Sine of the angle between tangents above which a breakpoint is a kink.
constexpr double kKink = 1e-9;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a(0) * b(1) - a(1) * b(0);
}

}  // namespace

SurfaceCurve::Point SurfaceCurve::at(int span, double xi) const {
  const UnivariateBasis& basis = curve_.basis().direction(0);
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

std::optional<SurfaceCurve::Point> SurfaceCurve::kinkAfter(int span, const Eigen::Vector2d& position) const {
  const UnivariateBasis& basis = curve_.basis().direction(0);
  if (span < 0 || span + 1 >= basis.numSpans()) return std::nullopt;
  const Point before = at(span, basis.spanEnd(span)), after = at(span + 1, basis.spanEnd(span));
  const double turn = cross(before.dx.normalized(), after.dx.normalized());
  const Eigen::Vector2d way = position - before.x;
  if (std::abs(turn) < kKink || way.dot(before.dx) < 0.0 || way.dot(after.dx) > 0.0) return std::nullopt;
  Point kink = before;
  kink.isKink = true;
  kink.normal = (before.normal + after.normal).normalized();
  const double distance = way.norm();
  if (way.dot(kink.normal) > 0.0 && distance > kRounding * (position.norm() + kink.x.norm()))
    kink.normal = way / distance;
  return kink;
}

std::optional<SurfaceCurve::Point> SurfaceCurve::project(const Eigen::Vector2d& position,
                                                         double start) const {
  const UnivariateBasis& basis = curve_.basis().direction(0);
  const int last = basis.numSpans() - 1;
  const double begin = 2.0 * basis.spanBegin(0) - basis.spanEnd(0),
               end = 2.0 * basis.spanEnd(last) - basis.spanBegin(last);
  double xi = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int span = basis.findSpan(xi);
    Point point = at(span, xi);
    const Eigen::Vector2d way = position - point.x;
    const double residual = way.dot(point.dx), square = point.dx.squaredNorm();
    if (std::abs(residual) <= kAngle * std::sqrt(square) * way.norm()) return point;
    const double slope = square - way.dot(point.ddx);
    const double next = std::clamp(xi + residual / (slope > 0.0 ? slope : square), begin, end);
    if (next == xi && (xi == begin || xi == end)) return std::nullopt;
    if (std::abs(next - xi) * std::sqrt(square) <= kRounding * (position.norm() + point.x.norm()))
      return at(next);
    if (const int there = basis.findSpan(next); there != span)
      if (const auto kink = kinkAfter(there > span ? span : span - 1, position)) return kink;
    xi = next;
  }
  return std::nullopt;
}

}  // namespace burnish
