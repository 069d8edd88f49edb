#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Half space below a plane: the tool occupies (x - origin)·normal < 0. A line in 2D.
struct Plane {
  static constexpr ShapeKind kind{"plane", "The half space behind a plane."};

  Point origin{0.0, 0.0, 0.0};
  Direction normal{0.0, 1.0, 0.0};  ///< towards the body

  /// With a normal of length 1, as results keep it.
  Plane made() const;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const;
  Eigen::Vector3d middle() const { return origin; }
  SurfaceMesh outline(int dim, double reach) const;

  /// Whether it is what results keep.
  bool isSound() const;
};

template <class Visitor>
void describe(Visitor& v, Plane& s) {
  v.field("origin", s.origin, {.required = true, .unit = "length"}, "A point of the plane.");
  v.field("normal", s.normal, {.required = true}, "Direction from the tool towards the body, of any length.");
}

template <class Archive>
void archive(Archive& a, Plane& s) {
  a("origin", s.origin);
  a("normal", s.normal);
}

void check(const Plane& plane, const ShapeProblems& problems);

}  // namespace burnish::inline tools
