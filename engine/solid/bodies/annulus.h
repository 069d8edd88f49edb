#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// Part of a ring: first parameter along the radius (inner to outer), second along the angle.
struct AnnulusBody {
  static constexpr BodyKind<2> kind{
      "annulus", "Part of a ring: radius first, then angle.", "an annulus", {1, 2}};

  Point center{0.0, 0.0};
  double innerRadius = 0.0;
  double outerRadius = 0.0;
  double startAngle = 0.0;     ///< degrees
  double openingAngle = 90.0;  ///< degrees, (0, 180)

  Patch<2> patch() const;
};

template <class Visitor>
void describe(Visitor& v, AnnulusBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Centre of the ring.");
  v.field("inner_radius", s.innerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `left`.");
  v.field("outer_radius", s.outerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `right`; greater than the inner radius.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` from the x axis, counterclockwise.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .below = 180, .unit = "degrees"},
          "Angle from the face `bottom` to the face `top`, counterclockwise.");
}

void check(const AnnulusBody& ring, const Problems& problems);

}  // namespace burnish::inline solid
