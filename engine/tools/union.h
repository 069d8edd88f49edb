#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/tools/die.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/shapes.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// Several shapes as one: the smallest gap wins. With a blend the minimum is a C² function that is lower
/// where two gaps differ by less than `blend`, by blend/6 at most for two parts: a fillet along the seam.
struct Union {
  std::vector<RigidShape> parts;
  double blend = 0.0;

  GapQuery query(const Eigen::Vector3d& x) const;

  /// That of the thinnest part.
  double halfThickness() const;
  /// That of the part that stands out most.
  double bulge() const;
  Eigen::Vector3d middle() const;
  SurfaceMesh outline(int dim, double reach) const;
};

/// A part of a union as a scene gives it.
struct UnionPart {
  SimpleShape shape;
  bool inside = false;
};

/// A union as a scene gives it.
struct UnionTool {
  static constexpr ShapeKind kind{"union", "Several shapes as one."};

  std::vector<UnionPart> parts;
  double blend = 0.0;

  Union made() const;
};

template <class Visitor>
void describe(Visitor& v, UnionPart& s) {
  v.alternatives("shape", s.shape, alternativesOf(s.shape), "Shape of the part.");
  v.field("inside", s.inside, {}, kInsideSentence);
}

template <class Visitor>
void describe(Visitor& v, UnionTool& s) {
  v.field("parts", s.parts, {.required = true, .minEntries = 1},
          "The shapes; where they overlap they are one.");
  v.field("blend", s.blend, {.atLeast = 0, .unit = "length"},
          "Length over which the seam between two parts is filled smoothly; sharp when 0.");
}

void check(const UnionTool& joined, const ShapeProblems& problems);

}  // namespace burnish::inline tools
