#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/schema/alternatives.h"
#include "engine/solid/bodies/profile.h"

namespace burnish::inline solid {

/// A curve or a face carried along a curve by rotation-minimising frames.
struct SweepBody {
  static constexpr PartKind kind{
      "sweep",
      "A curve in the plane, or a face in space, carried along a path, turning with its direction but never about it; "
      "needs no functions or spans."};
  static constexpr const char* name = "a sweep";
  static constexpr std::array nets{"profile", "path"};

  Net profile;
  Net path;
  std::optional<double> tolerance;  ///< a 10,000th of the path's length when left out

  int dim() const { return dimensionFrom(profile); }
  std::vector<KnotVector> knotVectors() const { return madeKnots(*this); }
  template <int Dim>
  Patch<Dim> patch() const;
};

template <class Visitor>
void describe(Visitor& v, SweepBody& s) {
  v.field(
      "profile", s.profile, {.required = true},
      "The curve or face where the path begins: the face `bottom` of a body of two dimensions, `back` in space.");
  v.field("path", s.path, {.required = true},
          "A smooth curve; the profile keeps its place to the curve's begin.");
  v.field(
      "tolerance", s.tolerance, {.above = 0, .unit = "length"},
      "Along a straight line and a circular arc the body is exact. Else it is a spline of the path's degree, at "
      "least 3, nowhere farther than this from the exact sweep; a 10000th of the path's length when left out.");
}

void check(const SweepBody& body, const Problems& problems);

}  // namespace burnish::inline solid
