#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Circular cone of infinite length, its tip rounded by a radius (0: sharp).
struct Cone {
  static constexpr ShapeKind kind{"cone", "A circular cone with a rounded tip (3D and axisymmetry).",
                                  ForBodies::SpatialOrAxisymmetric};

  Point tip{0.0, 0.0, 0.0};             ///< foremost point of the rounding
  Direction direction{0.0, 0.0, -1.0};  ///< from the tool to the front
  double halfAngle = 0.0;               ///< degrees, between the flank and the axis
  double radius = 0.0;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const;
  Eigen::Vector3d middle() const { return tip; }
  SurfaceMesh outline(int dim, double reach) const;
};

template <class Visitor>
void describe(Visitor& v, Cone& s) {
  v.field("tip", s.tip, {.required = true, .unit = "length"}, "Foremost point of the rounded tip.");
  v.field("direction", s.direction, {.required = true},
          "Direction from the tool to the front, of any length.");
  v.field("half_angle", s.halfAngle, {.required = true, .above = 0, .below = 90, .unit = "degrees"},
          "Angle between the axis and the flank.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"}, "Radius of the rounding; sharp when 0.");
}

void check(const Cone& cone, const ShapeProblems& problems);

}  // namespace burnish::inline tools
