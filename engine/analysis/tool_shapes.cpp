#include "engine/analysis/tool_shapes.h"

#include <algorithm>

namespace burnish {
namespace {

RigidShape convert(const PlaneToolSpec& spec) {
  return Plane{inSpace(spec.origin), inSpace(spec.normal).normalized()};
}
RigidShape convert(const CylinderToolSpec& spec) {
  return Cylinder{inSpace(spec.center), inSpace(spec.axis).normalized(), spec.radius};
}
RigidShape convert(const SphereToolSpec& spec) {
  return Sphere{inSpace(spec.center), spec.radius};
}

}  // namespace

Eigen::Vector3d inSpace(const std::vector<double>& coordinates) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::copy(coordinates.begin(), coordinates.end(), point.begin());
  return point;
}

RigidShape makeShape(const ToolShapeSpec& spec) {
  return std::visit([](const auto& shape) { return convert(shape); }, spec);
}

}  // namespace burnish
