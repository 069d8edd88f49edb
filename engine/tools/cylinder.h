#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Solid cylinder of infinite length; a disc in 2D, where the axis is z.
struct Cylinder {
  static constexpr ShapeKind kind{"cylinder", "A cylinder of infinite length; a disc in two dimensions."};

  Point center{0.0, 0.0, 0.0};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 1.0;

  /// With an axis of length 1, as results keep it.
  Cylinder made() const;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const { return radius; }
  Eigen::Vector3d middle() const { return center; }
  SurfaceMesh outline(int dim, double reach) const;

  /// Whether it is what results keep.
  bool isSound() const;
};

template <class Visitor>
void describe(Visitor& v, Cylinder& s) {
  v.field("center", s.center, {.required = true, .unit = "length"}, "A point of the axis.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"}, "Radius.");
  v.field("axis", s.axis, {}, "Direction of the axis; always z in two dimensions.");
}

template <class Archive>
void archive(Archive& a, Cylinder& s) {
  a("center", s.center);
  a("axis", s.axis);
  a("radius", s.radius);
}

void check(const Cylinder& cylinder, const ShapeProblems& problems);

}  // namespace burnish::inline tools
