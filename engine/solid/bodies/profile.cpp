#include "engine/solid/bodies/profile.h"

#include "engine/nurbs/constructions.h"
#include "engine/schema/problems.h"

namespace burnish::inline solid {

void checkProfile(const Net& profile, const Problems& problems) {
  if (profile.degrees.size() == 1)
    checkNet(profile, problems, "profile.", {2, 2}, "the plane");
  else
    checkNet(profile, problems, "profile.", {2, 3}, "");
}

Patch<2> inOwnSpace(const Patch<2, 3>& face) {
  return inPlane(face);
}

Patch<3> inOwnSpace(const Patch<3, 3>& volume) {
  return volume;
}

}  // namespace burnish::inline solid
