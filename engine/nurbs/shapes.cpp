#include "engine/nurbs/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/error.h"

namespace burnish {
namespace {

UnivariateBasis oneSpan(int degree) {
  return UnivariateBasis::bspline(KnotVector::uniform(degree, 1));
}

/// A circular arc of radius 1 about the origin as one rational quadratic: directions of its three control
/// points, scaled by their distances, and weights.
struct UnitArc {
  Eigen::Matrix<double, 2, 3> points;
  Eigen::Vector3d weights;
};

UnitArc unitArc(double start, double opening) {
  if (!(opening > 0.0) || !(opening < std::numbers::pi))
    throw Error(fmt::format(
        "arc: opening angle of {} rad; one rational quadratic needs more than 0 and less than pi", opening));
  const double half = 0.5 * opening, w = std::cos(half);
  const auto direction = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
  UnitArc arc;
  arc.points << direction(start), direction(start + half) / w, direction(start + opening);
  arc.weights << 1.0, w, 1.0;
  return arc;
}

void requireRadii(double inner, double outer) {
  if (!(inner > 0.0) || !(outer > inner))
    throw Error(
        fmt::format("ring: inner radius {} and outer radius {}; 0 < inner < outer is needed", inner, outer));
}

/// A plane patch swept along z.
Patch<3> extruded(const Patch<2>& base, double z, double height) {
  const Eigen::Index n = base.points().cols();
  Eigen::MatrixXd points(3, 2 * n);
  Eigen::VectorXd weights(2 * n);
  for (Eigen::Index layer = 0; layer < 2; ++layer) {
    points.block(0, layer * n, 2, n) = base.points();
    points.block(2, layer * n, 1, n).setConstant(z + static_cast<double>(layer) * height);
    weights.segment(layer * n, n) = base.weights();
  }
  return {TensorBasis<3>({base.basis().direction(0), base.basis().direction(1), oneSpan(1)}), points,
          weights};
}

}  // namespace

Patch<2> rectangle(const Eigen::Vector2d& origin, const Eigen::Vector2d& size) {
  if (!(size.array() > 0.0).all())
    throw Error(fmt::format("rectangle: size {} x {}; both must be positive", size(0), size(1)));
  Eigen::MatrixXd points(2, 4);
  points << 0.0, size(0), 0.0, size(0), 0.0, 0.0, size(1), size(1);
  points.colwise() += origin;
  return {TensorBasis<2>({oneSpan(1), oneSpan(1)}), points, Eigen::VectorXd::Ones(4)};
}

Patch<2> annulus(const Eigen::Vector2d& center, double innerRadius, double outerRadius, double startAngle,
                 double openingAngle) {
  requireRadii(innerRadius, outerRadius);
  const UnitArc arc = unitArc(startAngle, openingAngle);
  Eigen::MatrixXd points(2, 6);
  Eigen::VectorXd weights(6);
  for (int j = 0; j < 3; ++j) {
    points.col(2 * j) = center + innerRadius * arc.points.col(j);
    points.col(2 * j + 1) = center + outerRadius * arc.points.col(j);
    weights.segment(2 * j, 2).setConstant(arc.weights(j));
  }
  return {TensorBasis<2>({oneSpan(1), oneSpan(2)}), points, weights};
}

Patch<3> box(const Eigen::Vector3d& origin, const Eigen::Vector3d& size) {
  if (!(size(2) > 0.0)) throw Error(fmt::format("box: height {}; it must be positive", size(2)));
  return extruded(rectangle(origin.head<2>(), size.head<2>()), origin(2), size(2));
}

Patch<3> cylinderSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                         double startAngle, double openingAngle, double height) {
  if (!(height > 0.0)) throw Error(fmt::format("cylinder: height {}; it must be positive", height));
  return extruded(annulus(center.head<2>(), innerRadius, outerRadius, startAngle, openingAngle), center(2),
                  height);
}

Patch<3> sphereSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                       const Eigen::Vector2d& longitudes, const Eigen::Vector2d& latitudes) {
  requireRadii(innerRadius, outerRadius);
  const UnitArc around = unitArc(longitudes(0), longitudes(1) - longitudes(0));
  const UnitArc upward = unitArc(latitudes(0), latitudes(1) - latitudes(0));
  Eigen::MatrixXd points(3, 18);
  Eigen::VectorXd weights(18);
  for (int k = 0; k < 3; ++k) {
    const double rho = upward.points(0, k), z = upward.points(1, k);
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d direction(rho * around.points(0, j), rho * around.points(1, j), z);
      const int first = 2 * (j + 3 * k);
      points.col(first) = center + innerRadius * direction;
      points.col(first + 1) = center + outerRadius * direction;
      weights.segment(first, 2).setConstant(around.weights(j) * upward.weights(k));
    }
  }
  return {TensorBasis<3>({oneSpan(1), oneSpan(2), oneSpan(2)}), points, weights};
}

}  // namespace burnish
