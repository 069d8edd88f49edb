#include "engine/tools/cone.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/core/angles.h"
#include "engine/tools/edge.h"
#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {

using Eigen::Vector3d;

GapQuery Cone::query(const Vector3d& x) const {
  const AxisPlace place = placeAbout(tip, direction, x);
  return turned(wedgeProfile(place.r, place.h, radians(halfAngle), radius), place);
}

double Cone::halfThickness() const {
  return std::numeric_limits<double>::infinity();
}

SurfaceMesh Cone::outline(int dim, double reach) const {
  if (dim == 2) return Edge{tip, direction, Vector3d::UnitZ(), 2.0 * halfAngle, radius}.outline(2, reach);
  const OutlinePoints half =
      wedge(Vector3d::Zero(), Vector3d::UnitY(), Vector3d::UnitX(), radians(halfAngle), radius, reach);
  std::vector<Eigen::Vector2d> profile;
  for (const Vector3d& p : half)
    if (p.x() >= 0.0) profile.emplace_back(p.x(), p.y());
  if (profile.front().x() > 0.0) profile.insert(profile.begin(), {0.0, 0.0});
  std::reverse(profile.begin(), profile.end());
  return revolved(profile, tip, direction, false);
}

void check(const Cone& cone, const ShapeProblems& problems) {
  problems.requireFront("direction", cone.direction);
  if (!problems.isAxisymmetric()) return;
  if (problems.clean("direction") && cone.direction.x() != 0.0)
    problems.report("direction",
                    fmt::format("found [{}]; allowed in axisymmetry: a direction along the axis y.",
                                entriesText(cone.direction)));
  if (problems.clean("tip") && cone.tip.x() != 0.0)
    problems.report("tip", fmt::format("found [{}]; allowed in axisymmetry: a point of the axis, x = 0.",
                                       entriesText(cone.tip)));
}

}  // namespace burnish::inline tools
