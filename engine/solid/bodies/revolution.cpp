#include "engine/solid/bodies/revolution.h"

#include "engine/core/angles.h"
#include "engine/nurbs/constructions.h"
#include "engine/schema/problems.h"

namespace burnish::inline solid {

template <int Dim>
Patch<Dim> RevolutionBody::patch() const {
  return inOwnSpace(revolved(profile.patch<Dim - 1, 3>(), center, axis, radians(angle)));
}

void check(const RevolutionBody& body, const Problems& problems) {
  checkProfile(body.profile, problems);
  if (!problems.clean("axis")) return;
  if (body.axis.isZero(0.0))
    problems.report("axis", "found a vector of length 0; allowed: a direction, such as [0, 0, 1].");
  else if (body.dim() == 2 && (body.axis.x() != 0.0 || body.axis.y() != 0.0))
    problems.report("axis", "found an axis in the plane; allowed in two dimensions: [0, 0, 1].");
}

template Patch<2> RevolutionBody::patch() const;
template Patch<3> RevolutionBody::patch() const;

}  // namespace burnish::inline solid
