#include "engine/solid/bodies/sweep.h"

#include "engine/nurbs/constructions.h"
#include "engine/schema/problems.h"

namespace burnish::inline solid {

template <int Dim>
Patch<Dim> SweepBody::patch() const {
  constexpr double kShare = 1e-4;
  const Patch<1, 3> curve = path.patch<1, 3>();
  return inOwnSpace(
      sweptAlong(profile.patch<Dim - 1, 3>(), curve, tolerance.value_or(kShare * lengthOf(curve))));
}

void check(const SweepBody& body, const Problems& problems) {
  checkProfile(body.profile, problems);
  if (body.path.degrees.size() > 1)
    problems.report("path.degrees", "found a face; allowed: a curve, of one degree.");
  else if (body.dim() == 2)
    checkNet(body.path, problems, "path.", {2, 2}, "the plane");
  else
    checkNet(body.path, problems, "path.", {2, 3}, "");
}

template Patch<2> SweepBody::patch() const;
template Patch<3> SweepBody::patch() const;

}  // namespace burnish::inline solid
