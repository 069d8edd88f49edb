#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

struct Sphere {
  static constexpr ShapeKind kind{"sphere", "A sphere (3D).", ForBodies::Spatial};

  Point center{0.0, 0.0, 0.0};
  double radius = 1.0;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const { return radius; }
  Eigen::Vector3d middle() const { return center; }
  SurfaceMesh outline(int dim, double reach) const;

  /// Whether it is what results keep.
  bool isSound() const;
};

template <class Visitor>
void describe(Visitor& v, Sphere& s) {
  v.field("center", s.center, {.required = true, .unit = "length"}, "Centre.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
}

template <class Archive>
void archive(Archive& a, Sphere& s) {
  a("center", s.center);
  a("radius", s.radius);
}

}  // namespace burnish::inline tools
