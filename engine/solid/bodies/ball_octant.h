#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// Half a ball cut by two planes of symmetry that meet at its pole.
struct BallOctantBody {
  static constexpr BodyKind<3> kind{
      "ball-octant", "An eighth of a ball: half of it, cut by two planes of symmetry.", "a ball", {1, 2, 2}};

  Point center{0.0, 0.0, 0.0};
  double radius = 0.0;
  Direction pole{0.0, 0.0, -1.0};  ///< of any length, from the centre

  Patch<3> patch() const;
};

template <class Visitor>
void describe(Visitor& v, BallOctantBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Centre of the ball.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("pole", s.pole, {},
          "Direction from the centre to the middle of the half ball. The planes of symmetry `bottom` and "
          "`back` meet there, at a corner of the sphere `right`; `top` is the plane through the centre.");
}

void check(const BallOctantBody& ball, const Problems& problems);

}  // namespace burnish::inline solid
