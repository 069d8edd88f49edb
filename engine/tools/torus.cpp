#include "engine/tools/torus.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "engine/tools/outline_parts.h"
#include "engine/tools/profile_gap.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline tools {

GapQuery Torus::query(const Eigen::Vector3d& x) const {
  const AxisPlace place = placeAbout(center, axis, x);
  return turned(circleProfile({place.r - radius, place.h}, tubeRadius), place);
}

SurfaceMesh Torus::outline(int /*dim*/, double /*reach*/) const {
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k < kPiecesAround; ++k)
    profile.emplace_back(radius + tubeRadius * std::cos(k * kPieceAngle),
                         tubeRadius * std::sin(k * kPieceAngle));
  return revolved(profile, center, axis, true);
}

void check(const Torus& torus, const ShapeProblems& problems) {
  problems.requireAxis("axis", torus.axis);
  if (problems.clean("radius") && problems.clean("tube_radius") && torus.tubeRadius >= torus.radius)
    problems.report("tube_radius", fmt::format("found {}; allowed: a number below the radius {}.",
                                               torus.tubeRadius, torus.radius));
}

}  // namespace burnish::inline tools
