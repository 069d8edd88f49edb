#pragma once
#include <array>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/schema/alternatives.h"
#include "engine/schema/coordinates.h"
#include "engine/solid/bodies/profile.h"

namespace burnish::inline solid {

/// A curve moved to a face, or a face to a volume; exact.
struct ExtrusionBody {
  static constexpr PartKind kind{
      "extrusion",
      "A curve in the plane, or a face in space, moved along a vector; needs no functions or spans."};
  static constexpr const char* name = "an extrusion";
  static constexpr std::array nets{"profile"};

  Net profile;
  Direction vector;

  int dim() const { return dimensionFrom(profile); }
  std::vector<KnotVector> knotVectors() const { return madeKnots(*this); }
  template <int Dim>
  Patch<Dim> patch() const;
};

template <class Visitor>
void describe(Visitor& v, ExtrusionBody& s) {
  v.field("profile", s.profile, {.required = true},
          "The curve or face: the face `bottom` of a body of two dimensions, `back` in space.");
  v.field("vector", s.vector, {.required = true, .unit = "length"}, "From the profile to the opposite face.");
}

void check(const ExtrusionBody& body, const Problems& problems);

}  // namespace burnish::inline solid
