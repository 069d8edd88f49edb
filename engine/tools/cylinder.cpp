#include "engine/tools/cylinder.h"

#include <cmath>

#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {

using Eigen::Vector3d;

Cylinder Cylinder::made() const {
  return {center, axis.normalized(), radius};
}

GapQuery Cylinder::query(const Vector3d& x) const {
  const Vector3d a = axis.normalized();
  const Eigen::Matrix3d projector = Eigen::Matrix3d::Identity() - a * a.transpose();
  return roundGap(projector * (x - center), projector, radius);
}

SurfaceMesh Cylinder::outline(int dim, double reach) const {
  if (dim == 2) return line(ring(center, radius, Vector3d::UnitX(), Vector3d::UnitY()), true);
  return revolved({{radius, -reach}, {radius, reach}}, center, axis, false);
}

bool Cylinder::isSound() const {
  return center.allFinite() && std::abs(axis.norm() - 1.0) < 1e-9 && std::isfinite(radius) && radius > 0.0;
}

void check(const Cylinder& cylinder, const ShapeProblems& problems) {
  problems.requireAxis("axis", cylinder.axis);
}

}  // namespace burnish::inline tools
