#include "engine/nurbs/shapes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/error.h"

namespace burnish::inline nurbs {
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

void requireRadius(double radius) {
  if (!(radius > 0.0)) throw Error(fmt::format("disc: radius {}; it must be positive", radius));
}

/// A net of 3 x 3 points as homogeneous coordinates (w x, w y, w), first direction fastest.
using SquareNet = Eigen::Matrix<double, 3, 9>;

/// The patch of degrees 2 and 2 with this boundary; the middle follows from it (bilinearly blended).
Patch<2> squarePatch(SquareNet net) {
  net.col(4) = 0.5 * (net.col(1) + net.col(3) + net.col(5) + net.col(7)) -
               0.25 * (net.col(0) + net.col(2) + net.col(6) + net.col(8));
  return {TensorBasis<2>({oneSpan(2), oneSpan(2)}), net.colwise().hnormalized(), net.row(2).transpose()};
}

/// Columns: a right-handed frame whose last vector is the direction of `axis` and whose first one points to
/// the coordinate axis that follows its largest component.
Eigen::Matrix3d frameAlong(const Eigen::Vector3d& axis) {
  if (!(axis.norm() > 0.0)) throw Error("axis: found a vector of length 0; a direction is needed");
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  Eigen::Matrix3d frame;
  frame.col(2) = axis.normalized();
  const Eigen::Vector3d next = Eigen::Vector3d::Unit((largest + 1) % 3);
  frame.col(0) = (next - next.dot(frame.col(2)) * frame.col(2)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

/// Between two spheres about `center`: longitudes count from the first vector of the frame, latitudes to its
/// third one.
Patch<3> shell(const Eigen::Vector3d& center, const Eigen::Matrix3d& frame, double innerRadius,
               double outerRadius, const UnitArc& around, const UnitArc& upward) {
  Eigen::MatrixXd points(3, 18);
  Eigen::VectorXd weights(18);
  for (int k = 0; k < 3; ++k) {
    const double rho = upward.points(0, k), z = upward.points(1, k);
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d direction =
          frame * Eigen::Vector3d(rho * around.points(0, j), rho * around.points(1, j), z);
      const int first = 2 * (j + 3 * k);
      points.col(first) = center + innerRadius * direction;
      points.col(first + 1) = center + outerRadius * direction;
      weights.segment(first, 2).setConstant(around.weights(j) * upward.weights(k));
    }
  }
  return {TensorBasis<3>({oneSpan(1), oneSpan(2), oneSpan(2)}), points, weights};
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

Patch<2> disc(const Eigen::Vector2d& center, double radius, double startAngle) {
  requireRadius(radius);
  SquareNet net = SquareNet::Zero();
  // Nine places of the square that lie on its boundary, counterclockwise from the right lower corner.
  constexpr std::array<int, 9> boundary{2, 5, 8, 7, 6, 3, 0, 1, 2};
  for (int side = 0; side < 4; ++side) {
    const UnitArc arc = unitArc(startAngle + (side - 0.5) * std::numbers::pi / 2, std::numbers::pi / 2);
    for (int k = 0; k < 3; ++k)
      net.col(boundary[static_cast<std::size_t>(2 * side + k)]) =
          arc.weights(k) * (center + radius * arc.points.col(k)).homogeneous();
  }
  return squarePatch(net);
}

Patch<2> ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& size) {
  if (!(size.array() > 0.0).all())
    throw Error(fmt::format("ellipse: size {} x {}; both must be positive", size(0), size(1)));
  const Patch<2> unit = disc({0.0, 0.0}, 1.0, 0.0);
  return {unit.basis(), (0.5 * size.asDiagonal() * unit.points()).colwise() + center, unit.weights()};
}

Patch<2> discSector(const Eigen::Vector2d& center, double radius, double startAngle, double openingAngle) {
  requireRadius(radius);
  const double half = 0.5 * openingAngle;
  const UnitArc first = unitArc(startAngle, half), second = unitArc(startAngle + half, half);
  SquareNet net = SquareNet::Zero();
  const auto onArc = [&](const UnitArc& arc, int k) -> Eigen::Vector3d {
    return arc.weights(k) * (center + radius * arc.points.col(k)).homogeneous();
  };
  net.col(0) = center.homogeneous();
  for (int k = 0; k < 3; ++k) {
    net.col(2 + 3 * k) = onArc(first, k);
    net.col(8 - k) = onArc(second, k);
  }
  net.col(1) = 0.5 * (net.col(0) + net.col(2));
  net.col(3) = 0.5 * (net.col(0) + net.col(6));
  return squarePatch(net);
}

Patch<3> swept(const Patch<2>& base, const Eigen::Vector3d& begin, const Eigen::Vector3d& axis,
               double length) {
  if (!(length > 0.0)) throw Error(fmt::format("swept patch: length {}; it must be positive", length));
  const Eigen::Matrix3d frame = frameAlong(axis);
  const Eigen::Index n = base.points().cols();
  Eigen::MatrixXd points(3, 2 * n);
  points.leftCols(n) = (frame.leftCols<2>() * base.points()).colwise() + begin;
  points.rightCols(n) = points.leftCols(n).colwise() + length * frame.col(2);
  return {TensorBasis<3>({base.basis().direction(0), base.basis().direction(1), oneSpan(1)}), points,
          base.weights().replicate(2, 1)};
}

Patch<3> box(const Eigen::Vector3d& origin, const Eigen::Vector3d& size) {
  if (!(size(2) > 0.0)) throw Error(fmt::format("box: height {}; it must be positive", size(2)));
  return swept(rectangle({0.0, 0.0}, size.head<2>()), origin, Eigen::Vector3d::UnitZ(), size(2));
}

Patch<3> cylinderSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                         double startAngle, double openingAngle, double height) {
  return swept(annulus({0.0, 0.0}, innerRadius, outerRadius, startAngle, openingAngle), center,
               Eigen::Vector3d::UnitZ(), height);
}

Patch<3> sphereSegment(const Eigen::Vector3d& center, double innerRadius, double outerRadius,
                       const Eigen::Vector2d& longitudes, const Eigen::Vector2d& latitudes) {
  requireRadii(innerRadius, outerRadius);
  const UnitArc around = unitArc(longitudes(0), longitudes(1) - longitudes(0));
  const UnitArc upward = unitArc(latitudes(0), latitudes(1) - latitudes(0));
  return shell(center, Eigen::Matrix3d::Identity(), innerRadius, outerRadius, around, upward);
}

Patch<3> ballOctant(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& pole) {
  requireRadius(radius);
  const Eigen::Matrix3d along = frameAlong(pole);
  Eigen::Matrix3d frame;
  frame << along.col(2), along.col(0), along.col(1);
  const UnitArc quarter = unitArc(0.0, std::numbers::pi / 2);
  return shell(center, frame, 0.0, radius, quarter, quarter);
}

}  // namespace burnish::inline nurbs
