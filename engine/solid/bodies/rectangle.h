#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline solid {

/// A rectangle along the axes.
struct RectangleBody {
  static constexpr BodyKind<2> kind{"rectangle", "A rectangle along the axes.", "a rectangle", {1, 1}};

  Point origin{0.0, 0.0};  ///< lower left corner
  Direction size;          ///< width and height, > 0

  Patch<2> patch() const;
};

template <class Visitor>
void describe(Visitor& v, RectangleBody& s) {
  v.field("origin", s.origin, {.unit = "length"}, "Lower left corner.");
  v.field("size", s.size, {.required = true, .above = 0, .unit = "length"}, "Width and height.");
}

}  // namespace burnish::inline solid
