#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

struct Torus {
  static constexpr ShapeKind kind{"torus", "A torus (3D).", ForBodies::Spatial};

  Point center{0.0, 0.0, 0.0};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 1.0;       ///< of the circle in the middle of the tube
  double tubeRadius = 0.25;  ///< smaller than `radius`

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const { return tubeRadius; }
  double halfThicknessOfDie() const { return radius - tubeRadius; }
  Eigen::Vector3d middle() const { return center; }
  SurfaceMesh outline(int dim, double reach) const;
};

template <class Visitor>
void describe(Visitor& v, Torus& s) {
  v.field("center", s.center, {.required = true, .unit = "length"}, "Centre.");
  v.field("radius", s.radius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the circle in the middle of the tube.");
  v.field("tube_radius", s.tubeRadius, {.required = true, .above = 0, .unit = "length"},
          "Radius of the tube, smaller than the radius.");
  v.field("axis", s.axis, {}, "Direction of the axis.");
}

void check(const Torus& torus, const ShapeProblems& problems);

}  // namespace burnish::inline tools
