#include "engine/solid/bodies/tube.h"

#include "engine/core/angles.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bodies/body_checks.h"

namespace burnish::inline solid {

Patch<3> TubeBody::patch() const {
  const Patch<2> ring =
      annulus({0.0, 0.0}, innerRadius, outerRadius, radians(startAngle), radians(openingAngle));
  return swept(ring, center, axis, length);
}

void check(const TubeBody& tube, const Problems& problems) {
  requireRing(problems, tube.innerRadius, tube.outerRadius);
  requireDirection(problems, "axis", tube.axis);
}

}  // namespace burnish::inline solid
