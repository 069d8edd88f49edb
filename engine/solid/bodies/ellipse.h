#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline solid {

/// A whole ellipse with axes along x and y.
struct EllipseBody {
  static constexpr BodyKind<2> kind{
      "ellipse", "A whole ellipse with axes along x and y.", "an ellipse", {2, 2}};

  Point center{0.0, 0.0};
  Direction size;  ///< width and height, > 0

  Patch<2> patch() const;
};

template <class Visitor>
void describe(Visitor& v, EllipseBody& s) {
  v.field("center", s.center, {.unit = "length"}, "Centre of the ellipse.");
  v.field("size", s.size, {.required = true, .above = 0, .unit = "length"},
          "Width and height, along x and y; the faces are named as those of a whole disc.");
}

}  // namespace burnish::inline solid
