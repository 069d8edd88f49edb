#include "engine/tools/plane.h"

#include <cmath>
#include <limits>

#include "engine/tools/outline_parts.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {

using Eigen::Vector3d;

Plane Plane::made() const {
  return {origin, normal.normalized()};
}

GapQuery Plane::query(const Vector3d& x) const {
  GapQuery answer;
  answer.normal = normal.normalized();
  answer.gap = (x - origin).dot(answer.normal);
  return answer;
}

double Plane::halfThickness() const {
  return std::numeric_limits<double>::infinity();
}

SurfaceMesh Plane::outline(int dim, double reach) const {
  const Vector3d n = normal.normalized();
  if (dim == 2) {
    const Vector3d along(-n.y(), n.x(), 0.0);
    return line({origin - reach * along, origin + reach * along}, false);
  }
  const Vector3d a = reach * n.unitOrthogonal(), b = n.cross(a);
  return strips({{origin - a - b, origin + a - b}, {origin - a + b, origin + a + b}}, false, false);
}

bool Plane::isSound() const {
  return origin.allFinite() && std::abs(normal.norm() - 1.0) < 1e-9;
}

void check(const Plane& plane, const ShapeProblems& problems) {
  if (problems.clean("normal") && plane.normal.isZero(0.0))
    problems.report("normal",
                    "found a vector without length; allowed: a direction from the tool towards the body.");
}

}  // namespace burnish::inline tools
