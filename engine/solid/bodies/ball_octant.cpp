#include "engine/solid/bodies/ball_octant.h"

#include "engine/nurbs/shapes.h"
#include "engine/solid/bodies/body_checks.h"

namespace burnish::inline solid {

Patch<3> BallOctantBody::patch() const {
  return ballOctant(center, radius, pole);
}

void check(const BallOctantBody& ball, const Problems& problems) {
  requireDirection(problems, "pole", ball.pole);
}

}  // namespace burnish::inline solid
