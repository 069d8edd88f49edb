#include "engine/tools/rigid_shape.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace burnish {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double thicknessAround(const AnyShape& solid);

double thicknessOf(const Plane&) {
  return kInfinity;
}
double thicknessOf(const Cylinder& cylinder) {
  return cylinder.radius;
}
double thicknessOf(const Sphere& sphere) {
  return sphere.radius;
}
double thicknessOf(const Edge&) {
  return kInfinity;
}
double thicknessOf(const Cone&) {
  return kInfinity;
}
double thicknessOf(const Torus& torus) {
  return torus.tubeRadius;
}
double thicknessOf(const RoundedBox& box) {
  return 0.5 * box.size.minCoeff();
}
template <int P>
double thicknessOf(const NurbsShape<P>& shape) {
  return halfThicknessOf(shape);
}
double thicknessOf(const FacetedShape& shape) {
  return halfThicknessOf(shape);
}
double thicknessOf(const Die& die) {
  return thicknessAround(*die.solid);
}

double thicknessOf(const Union& joined) {
  double smallest = kInfinity;
  for (const auto& part : joined.parts) smallest = std::min(smallest, halfThickness(part->shape));
  return smallest;
}

Eigen::Vector3d middleOfBox(const Eigen::Matrix3Xd& points) {
  return 0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
}

struct Middle {
  Eigen::Vector3d operator()(const Plane& plane) const { return plane.origin; }
  Eigen::Vector3d operator()(const Cylinder& cylinder) const { return cylinder.center; }
  Eigen::Vector3d operator()(const Sphere& sphere) const { return sphere.center; }
  Eigen::Vector3d operator()(const Edge& edge) const { return edge.tip; }
  Eigen::Vector3d operator()(const Cone& cone) const { return cone.tip; }
  Eigen::Vector3d operator()(const Torus& torus) const { return torus.center; }
  Eigen::Vector3d operator()(const RoundedBox& box) const { return box.center; }
  Eigen::Vector3d operator()(const NurbsCurve& curve) const { return middleOfBox(outlineOf(curve).points); }
  Eigen::Vector3d operator()(const NurbsSurface& surface) const {
    return middleOfBox(outlineOf(surface).points);
  }
  Eigen::Vector3d operator()(const FacetedShape& shape) const { return middleOfBox(outlineOf(shape).points); }
  Eigen::Vector3d operator()(const Die& die) const { return middleOf(die.solid->shape); }
  Eigen::Vector3d operator()(const Union& joined) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& part : joined.parts) sum += middleOf(part->shape);
    return sum / static_cast<double>(joined.parts.size());
  }
};

/// Of the die around a solid.
double thicknessAround(const AnyShape& solid) {
  if (const auto* torus = std::get_if<Torus>(&solid.shape)) return torus->radius - torus->tubeRadius;
  return kInfinity;
}

}  // namespace

Die dieOf(RigidShape solid) {
  return {std::make_shared<const AnyShape>(AnyShape{std::move(solid)})};
}

Union unionOf(const std::vector<RigidShape>& parts, double blend) {
  Union joined;
  for (const RigidShape& part : parts)
    joined.parts.push_back(std::make_shared<const AnyShape>(AnyShape{part}));
  joined.blend = blend;
  return joined;
}

GapQuery queryGap(const RigidShape& shape, const Eigen::Vector3d& x) {
  return std::visit([&](const auto& s) { return s.query(x); }, shape);
}

Eigen::Vector3d middleOf(const RigidShape& shape) {
  return std::visit(Middle{}, shape);
}

double halfThickness(const RigidShape& shape) {
  return std::visit([](const auto& s) { return thicknessOf(s); }, shape);
}

}  // namespace burnish
