#pragma once
#include <string>
#include <vector>

#include "engine/nurbs/knot_vector.h"
#include "engine/nurbs/patch.h"
#include "engine/schema/alternatives.h"

namespace burnish {

class Problems;

/// Control points, weights and knot vectors given in the scene, or in a YAML file of the same keys.
/// `degrees`, `knots` one entry per direction; points with the first direction fastest; weights may be left
/// out (all 1).
struct ControlNetBody {
  static constexpr PartKind kind{"control-net",
                                 "Control points, weights and knots; needs no functions or spans."};

  std::string file;  ///< relative to the scene's file; replaced by its contents when the scene is read
  std::vector<int> degrees;
  std::vector<std::vector<double>> knots;
  std::vector<std::vector<double>> points;
  std::vector<double> weights;

  /// Throws `Error` if one of them is none.
  std::vector<KnotVector> knotVectors() const;

  template <int Dim>
  Patch<Dim> patch() const;
};

template <class Visitor>
void describe(Visitor& v, ControlNetBody& s) {
  v.field("file", s.file, {},
          "YAML file that holds the other keys of the control net, beside the scene; instead of giving them "
          "here.");
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 2, .maxEntries = 3},
          "Degree in each of the two or three parametric directions.");
  v.field("knots", s.knots, {.minEntries = 2, .maxEntries = 3}, "An open knot vector for each direction.");
  v.field("points", s.points, {.minEntries = 4, .unit = "length"},
          "Coordinates of the control points, the first direction fastest.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
}

void check(const ControlNetBody& net, const Problems& problems);

}  // namespace burnish
