#pragma once
#include "engine/nurbs/patch.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/body_kind.h"

namespace burnish::inline solid {

/// A box along the axes.
struct BoxBody {
  static constexpr BodyKind<3> kind{"box", "A box along the axes.", "a box", {1, 1, 1}};

  Point origin{0.0, 0.0, 0.0};
  Direction size;

  Patch<3> patch() const;
};

template <class Visitor>
void describe(Visitor& v, BoxBody& s) {
  v.field("origin", s.origin, {.unit = "length"}, "Corner with the smallest coordinates.");
  v.field("size", s.size, {.required = true, .above = 0, .unit = "length"}, "Edge lengths in x, y and z.");
}

}  // namespace burnish::inline solid
