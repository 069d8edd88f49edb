#pragma once
#include <array>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/schema/alternatives.h"
#include "engine/solid/bodies/profile.h"

namespace burnish::inline solid {

/// The face between four curves.
struct CoonsBody {
  static constexpr PartKind kind{
      "coons",
      "The face between four curves of the plane that meet, bilinearly blended (Coons); needs no functions or spans."};
  static constexpr const char* name = "a Coons patch";
  static constexpr std::array nets{"bottom", "right", "top", "left"};

  Net bottom, right, top, left;

  int dim() const { return 2; }
  std::vector<KnotVector> knotVectors() const { return knotVectorsOf(patch<2>()); }

  /// Dim: 2. Throws `Error` if the curves bend so much that a weight is not positive.
  template <int Dim>
  Patch<Dim> patch() const;
};

template <class Visitor>
void describe(Visitor& v, CoonsBody& s) {
  v.field("bottom", s.bottom, {.required = true}, "Curve of the face `bottom`, from left to right.");
  v.field("right", s.right, {.required = true}, "Curve of the face `right`, from bottom to top.");
  v.field("top", s.top, {.required = true}, "Curve of the face `top`, from left to right.");
  v.field("left", s.left, {.required = true}, "Curve of the face `left`, from bottom to top.");
}

void check(const CoonsBody& body, const Problems& problems);

}  // namespace burnish::inline solid
