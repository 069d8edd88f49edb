#include "engine/solid/bodies/disc.h"

#include "engine/core/angles.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bodies/body_checks.h"

namespace burnish::inline solid {

Patch<2> DiscBody::patch() const {
  const double start = radians(startAngle);
  return openingAngle == 360.0 ? disc(center.head<2>(), radius, start)
                               : discSector(center.head<2>(), radius, start, radians(openingAngle));
}

void check(const DiscBody& disc, const Problems& problems) {
  requireOpening(problems, disc.openingAngle, "disc");
}

}  // namespace burnish::inline solid
