#include "engine/solid/bodies/extrusion.h"

#include "engine/nurbs/constructions.h"
#include "engine/solid/bodies/body_checks.h"

namespace burnish::inline solid {

template <int Dim>
Patch<Dim> ExtrusionBody::patch() const {
  return inOwnSpace(extruded(profile.patch<Dim - 1, 3>(), vector));
}

void check(const ExtrusionBody& body, const Problems& problems) {
  checkProfile(body.profile, problems);
  requireDirection(problems, "vector", body.vector);
}

template Patch<2> ExtrusionBody::patch() const;
template Patch<3> ExtrusionBody::patch() const;

}  // namespace burnish::inline solid
