#include "engine/solid/bodies/cylinder.h"

#include "engine/nurbs/shapes.h"
#include "engine/solid/bodies/body_checks.h"
#include "engine/solid/bodies/disc.h"

namespace burnish::inline solid {

Patch<3> CylinderBody::patch() const {
  const DiscBody base{{0.0, 0.0}, radius, startAngle, openingAngle};
  return swept(base.patch(), center, axis, length);
}

void check(const CylinderBody& cylinder, const Problems& problems) {
  requireOpening(problems, cylinder.openingAngle, "cylinder");
  requireDirection(problems, "axis", cylinder.axis);
}

}  // namespace burnish::inline solid
