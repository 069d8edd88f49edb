#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// Part of a tube: radius (inner to outer), angle, axis. Angles count from the coordinate axis that follows
/// the largest component of `axis`.
struct TubeBody {
  static constexpr BodyKind<3> kind{
      "tube", "Part of a tube: radius first, then angle, then axis.", "a tube", {1, 2, 1}};

  Point center{0.0, 0.0, 0.0};    ///< begin of the axis
  Direction axis{0.0, 0.0, 1.0};  ///< of any length
  double innerRadius = 0.0;
  double outerRadius = 0.0;
  double length = 0.0;
  double startAngle = 0.0;     ///< degrees
  double openingAngle = 90.0;  ///< degrees, (0, 180)

  Patch<3> patch() const;
};

template <class Visitor>
void describe(Visitor& v, TubeBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Begin of the axis.");
  v.field("axis", s.axis, {}, "Direction of the axis, from the face `back` to the face `front`.");
  v.field("inner_radius", s.innerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `left`.");
  v.field("outer_radius", s.outerRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the face `right`; greater than the inner radius.");
  v.field("length", s.length, {.required = true, .above = 0, .unit = "length"}, "Length of the axis.");
  v.field("start_angle", s.startAngle, {.atLeast = -360, .atMost = 360, .unit = "degrees"},
          "Angle of the face `bottom` about the axis, from the coordinate axis that follows the largest "
          "component of `axis`: x for an axis along z, y along x, z along y.");
  v.field("opening_angle", s.openingAngle, {.above = 0, .below = 180, .unit = "degrees"},
          "Angle from the face `bottom` to the face `top`.");
}

void check(const TubeBody& tube, const Problems& problems);

}  // namespace burnish::inline solid
