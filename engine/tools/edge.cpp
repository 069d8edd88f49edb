#include "engine/tools/edge.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/angles.h"
#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {

using Eigen::Vector3d;

GapQuery Edge::query(const Vector3d& x) const {
  const Vector3d front = direction.normalized();
  const Vector3d across = along.cross(front).normalized();
  const double s = (x - tip).dot(across);
  ProfileGap profile = wedgeProfile(std::abs(s), (x - tip).dot(front), radians(0.5 * angle), radius);
  if (s < 0.0) profile.part = -profile.part;
  return lifted(profile, s < 0.0 ? Vector3d(-across) : across, front);
}

double Edge::halfThickness() const {
  return std::numeric_limits<double>::infinity();
}

SurfaceMesh Edge::outline(int dim, double reach) const {
  const Vector3d front = direction.normalized();
  const Vector3d across = along.cross(front).normalized();
  const Vector3d upwards = front.cross(across);
  const OutlinePoints profile = wedge(tip, front, across, radians(0.5 * angle), radius, reach);
  if (dim == 2) {
    const bool isRight = across.x() * -front.y() + across.y() * front.x() > 0.0;
    return line(isRight ? profile : OutlinePoints(profile.rbegin(), profile.rend()), false);
  }
  std::vector<OutlinePoints> rows(2);
  for (const Vector3d& p : profile) {
    rows[0].push_back(p - reach * upwards);
    rows[1].push_back(p + reach * upwards);
  }
  return strips(rows, false, false);
}

void check(const Edge& edge, const ShapeProblems& problems) {
  problems.requireFront("direction", edge.direction);
  problems.requireAxis("along", edge.along);
  if (problems.dim() == 3 && problems.clean("direction") && problems.clean("along") &&
      areParallel(edge.direction, edge.along))
    problems.report("along", fmt::format("found [{}], parallel to direction; allowed: a direction across it.",
                                         entriesText(edge.along)));
}

}  // namespace burnish::inline tools
