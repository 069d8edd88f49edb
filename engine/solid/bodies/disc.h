#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// A disc, whole or a sector of it.
struct DiscBody {
  static constexpr BodyKind<2> kind{"disc", "A disc, whole or a sector of it.", "a disc", {2, 2}};

  Point center{0.0, 0.0};
  double radius = 0.0;
  double startAngle = 0.0;      ///< degrees
  double openingAngle = 360.0;  ///< degrees, (0, 180), or 360 for the whole disc

  Patch<2> patch() const;
};

template <class Visitor>
void describe(Visitor& v, DiscBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Centre of the disc.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` of a sector, of the middle of the face `right` of a whole disc, from "
          "the x axis, counterclockwise.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .atMost = 360, .unit = "degrees"},
          "360: the whole disc; its faces `right`, `top`, `left` and `bottom` are quarters of the circle. "
          "Below 180: the angle of a sector from the straight face `bottom` to the straight face `left`, "
          "with the faces `right` and `top` along its arc.");
}

void check(const DiscBody& disc, const Problems& problems);

}  // namespace burnish::inline solid
