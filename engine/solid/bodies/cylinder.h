#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// A solid cylinder, whole or a sector of it; angles as those of a tube.
struct CylinderBody {
  static constexpr BodyKind<3> kind{
      "cylinder",
      "A solid cylinder, whole or a sector of it; third direction along the axis.",
      "a cylinder",
      {2, 2, 1}};

  Point center{0.0, 0.0, 0.0};    ///< begin of the axis
  Direction axis{0.0, 0.0, 1.0};  ///< of any length
  double radius = 0.0;
  double length = 0.0;
  double startAngle = 0.0;      ///< degrees
  double openingAngle = 360.0;  ///< degrees, (0, 180), or 360 for the whole cylinder

  Patch<3> patch() const;
};

template <class Visitor>
void describe(Visitor& v, CylinderBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Begin of the axis.");
  v.field("axis", s.axis, {}, "Direction of the axis, from the face `back` to the face `front`.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("length", s.length, {.required = true, .above = 0, .unit = "length"}, "Length of the axis.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle about the axis of the face `bottom` of a sector, of the middle of the face `right` of a "
          "whole cylinder; counted as that of a tube.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .atMost = 360, .unit = "degrees"},
          "360: the whole cylinder, with the faces `right`, `top`, `left` and `bottom` around its surface. "
          "Below 180: the angle of a sector from the plane face `bottom` to the plane face `left`, with the "
          "faces `right` and `top` along its surface.");
}

void check(const CylinderBody& cylinder, const Problems& problems);

}  // namespace burnish::inline solid
