#include "engine/analysis/tool_shapes.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/tools/surface_file.h"

namespace burnish {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

RigidShape convert(const PlaneToolSpec& spec) {
  return Plane{inSpace(spec.origin), inSpace(spec.normal).normalized()};
}
RigidShape convert(const CylinderToolSpec& spec) {
  return Cylinder{inSpace(spec.center), inSpace(spec.axis).normalized(), spec.radius};
}
RigidShape convert(const SphereToolSpec& spec) {
  return Sphere{inSpace(spec.center), spec.radius};
}
RigidShape convert(const EdgeToolSpec& spec) {
  return Edge{inSpace(spec.tip), inSpace(spec.direction), inSpace(spec.along), radians(0.5 * spec.angle),
              spec.radius};
}
RigidShape convert(const ConeToolSpec& spec) {
  return Cone{inSpace(spec.tip), inSpace(spec.direction), radians(spec.halfAngle), spec.radius};
}
RigidShape convert(const TorusToolSpec& spec) {
  return Torus{inSpace(spec.center), inSpace(spec.axis), spec.radius, spec.tubeRadius};
}

/// Columns: the given first axis, the part of the second across it, and what is perpendicular to both.
Eigen::Matrix3d orthonormalAxes(const std::vector<std::vector<double>>& axes) {
  if (axes.empty()) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d result;
  result.col(0) = inSpace(axes[0]).normalized();
  const Eigen::Vector3d second =
      axes.size() > 1 ? inSpace(axes[1]) : Eigen::Vector3d::UnitZ().cross(result.col(0));
  result.col(2) = result.col(0).cross(second).normalized();
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

RigidShape convert(const BoxToolSpec& spec) {
  RoundedBox box{inSpace(spec.center), inSpace(spec.size), spec.radius, orthonormalAxes(spec.axes)};
  if (spec.size.size() == 2) box.size(2) = std::numeric_limits<double>::infinity();
  return box;
}

template <int P>
RigidShape nurbsShape(const NurbsToolSpec& spec) {
  std::vector<UnivariateBasis> directions;
  for (std::size_t d = 0; d < spec.knots.size(); ++d)
    directions.push_back(UnivariateBasis::bspline(KnotVector(spec.degrees[d], spec.knots[d])));
  Eigen::MatrixXd points(3, static_cast<Eigen::Index>(spec.points.size()));
  for (std::size_t a = 0; a < spec.points.size(); ++a)
    points.col(static_cast<Eigen::Index>(a)) = inSpace(spec.points[a]);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(points.cols());
  std::copy(spec.weights.begin(), spec.weights.end(), weights.begin());
  return makeNurbsShape(Patch<P, 3>(TensorBasis<P>(std::move(directions)), std::move(points), weights),
                        spec.flip);
}

RigidShape convert(const NurbsToolSpec& spec) {
  return spec.degrees.size() == 1 ? nurbsShape<1>(spec) : nurbsShape<2>(spec);
}
RigidShape convert(const PolylineToolSpec& spec) {
  if (!spec.file.empty()) return makeFacetedShape(readPolyline(spec.file, spec.closed), spec.smoothing);
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : spec.points) points.emplace_back(point[0], point[1]);
  return makeFacetedShape(polyline(std::move(points), spec.closed, "points"), spec.smoothing);
}
RigidShape convert(const MeshToolSpec& spec) {
  return makeFacetedShape(readSurface(spec.file, spec.scale, spec.open), spec.smoothing);
}

RigidShape convert(const UnionToolSpec& spec);

template <class Spec>
RigidShape oriented(const Spec& spec) {
  RigidShape shape = std::visit([](const auto& s) { return convert(s); }, spec.shape);
  return spec.inside ? RigidShape(dieOf(std::move(shape))) : shape;
}

RigidShape convert(const UnionToolSpec& spec) {
  std::vector<RigidShape> parts;
  for (const ToolPartSpec& part : spec.parts) parts.push_back(oriented(part));
  return unionOf(parts, spec.blend);
}

}  // namespace

Eigen::Vector3d inSpace(const std::vector<double>& coordinates) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::copy(coordinates.begin(), coordinates.end(), point.begin());
  return point;
}

RigidShape makeShape(const ToolSpec& spec) {
  return oriented(spec);
}

}  // namespace burnish
