#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/nurbs/knot_vector.h"
#include "engine/nurbs/net_words.h"
#include "engine/nurbs/patch.h"
#include "engine/schema/rule.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// Control points, weights and knots of a curve, a face or a body, given in the scene or in a file. `degrees`, `knots` one
/// entry per direction; points with the first direction fastest; weights may be left out (all 1).
struct Net {
  std::string file;  ///< relative to the scene's file; replaced by its contents when the scene is read
  std::optional<int> entry;           ///< which one of several in the file; taken away with it
  std::optional<std::string> face{};  ///< of a CAD file: as the next two, taken away with it
  std::optional<LengthUnit> unit{};
  std::optional<bool> flip{};  ///< its first direction becomes the second one
  std::vector<int> degrees;
  std::vector<std::vector<double>> knots;  ///< of profiles they may be left out: see `knotVectors`
  std::vector<std::vector<double>> points;
  std::vector<double> weights;

  /// Those given; else, of a curve, uniform ones over [0, 1] for its number of points, of more directions one span each.
  /// Throws `Error` if one of them is none.
  std::vector<KnotVector> knotVectors() const;

  /// Coordinates that are not given are zero.
  template <int P, int S>
  Patch<P, S> patch() const;
};

/// The keys of a file that holds a net.
template <class Visitor>
void describeNetFile(Visitor& v, Net& s) {
  v.field("file", s.file, {}, kBodyNetFileSentence);
  v.field("entry", s.entry, {.atLeast = 0}, kNetEntrySentence);
  v.field("face", s.face, {}, kNetFaceSentence);
  v.field("unit", s.unit, {}, kNetUnitSentence);
  v.field("flip", s.flip, {}, kNetFlipSentence);
}

/// A curve or a face from which a body is made.
template <class Visitor>
void describe(Visitor& v, Net& s) {
  describeNetFile(v, s);
  v.field("degrees", s.degrees, {.atLeast = 1, .atMost = 10, .minEntries = 1, .maxEntries = 2},
          "Degree of a curve, or in both directions of a face.");
  v.field(
      "knots", s.knots, {.minEntries = 1, .maxEntries = 2},
      "An open knot vector for each direction. When left out those of a curve are uniform, and a face is one span "
      "in each direction.");
  v.field("points", s.points, {.minEntries = 2, .unit = "length"},
          "Coordinates of the control points, the first direction fastest.");
  v.field("weights", s.weights, {.above = 0}, "One weight per control point; all 1 when left out.");
}

/// Degrees, knots, points and weights fit together, and the points have so many coordinates (the second number: or so
/// many). key: of the mapping that holds them, with a point behind it; empty for the shape itself. of: "the body", ...
void checkNet(const Net& net, const Problems& problems, const std::string& key,
              std::array<std::size_t, 2> coordinates, const char* of);

/// Knots of a patch in all directions.
template <int P, int S>
std::vector<KnotVector> knotVectorsOf(const Patch<P, S>& patch) {
  std::vector<KnotVector> knots;
  for (int d = 0; d < P; ++d)
    knots.emplace_back(patch.basis().direction(d).degree(), patch.basis().direction(d).knots());
  return knots;
}

}  // namespace burnish::inline solid
