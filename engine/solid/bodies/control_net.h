#pragma once
#include <vector>

#include "engine/schema/alternatives.h"
#include "engine/solid/bodies/net.h"

namespace burnish::inline solid {

/// A body whose control points, weights and knots are given.
struct ControlNetBody : Net {
  static constexpr PartKind kind{"control-net",
                                 "Control points, weights and knots; needs no functions or spans."};
  static constexpr const char* name = "a control net";

  /// 0 without degrees.
  int dim() const { return static_cast<int>(degrees.size()); }

  template <int Dim>
  Patch<Dim> patch() const {
    return Net::patch<Dim, Dim>();
  }
};

template <class Visitor>
void describe(Visitor& v, ControlNetBody& s) {
  describeNetFile(v, s);
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 2, .maxEntries = 3},
          "Degree in each of the two or three parametric directions.");
  v.field("knots", s.knots, {.minEntries = 2, .maxEntries = 3}, "An open knot vector for each direction.");
  v.field("points", s.points, {.minEntries = 4, .unit = "length"},
          "Coordinates of the control points, the first direction fastest.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
}

void check(const ControlNetBody& net, const Problems& problems);

}  // namespace burnish::inline solid
