#include "engine/contact/rigid_shape.h"

#include <limits>

namespace burnish {
namespace {

/// Gap to a surface at distance R from a point or an axis, eq. (27); `v` leads from there to x and lies in
/// the range of the projector I_⊥. On the axis itself any direction is as good as another; the curvature term
/// is left at zero.
GapQuery roundGap(const Eigen::Vector3d& v, const Eigen::Matrix3d& projector, double radius) {
  GapQuery answer;
  const double distance = v.norm();
  answer.gap = distance - radius;
  if (distance == 0.0) {
    answer.normal = projector.col(1).normalized();
    return answer;
  }
  answer.normal = v / distance;
  answer.dNormal = (projector - answer.normal * answer.normal.transpose()) / distance;
  return answer;
}

}  // namespace

GapQuery Plane::query(const Eigen::Vector3d& x) const {
  GapQuery answer;
  answer.normal = normal.normalized();
  answer.gap = (x - origin).dot(answer.normal);
  return answer;
}

GapQuery Cylinder::query(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d a = axis.normalized();
  const Eigen::Matrix3d projector = Eigen::Matrix3d::Identity() - a * a.transpose();
  return roundGap(projector * (x - center), projector, radius);
}

GapQuery Sphere::query(const Eigen::Vector3d& x) const {
  return roundGap(x - center, Eigen::Matrix3d::Identity(), radius);
}

GapQuery queryGap(const RigidShape& shape, const Eigen::Vector3d& x) {
  return std::visit([&](const auto& s) { return s.query(x); }, shape);
}

Eigen::Vector3d middleOf(const RigidShape& shape) {
  struct Middle {
    Eigen::Vector3d operator()(const Plane& plane) const { return plane.origin; }
    Eigen::Vector3d operator()(const Cylinder& cylinder) const { return cylinder.center; }
    Eigen::Vector3d operator()(const Sphere& sphere) const { return sphere.center; }
  };
  return std::visit(Middle{}, shape);
}

double curvatureRadius(const RigidShape& shape) {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cylinder->radius;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  return std::numeric_limits<double>::infinity();
}

}  // namespace burnish
