#include "engine/solid/bodies/annulus.h"

#include "engine/core/angles.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/bodies/body_checks.h"

namespace burnish::inline solid {

Patch<2> AnnulusBody::patch() const {
  return annulus(center.head<2>(), innerRadius, outerRadius, radians(startAngle), radians(openingAngle));
}

void check(const AnnulusBody& ring, const Problems& problems) {
  requireRing(problems, ring.innerRadius, ring.outerRadius);
}

}  // namespace burnish::inline solid
