#pragma once
#include <Eigen/Dense>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Wedge between two half planes, its edge rounded by a radius (0: sharp).
struct Edge {
  static constexpr ShapeKind kind{"edge", "A wedge between two half planes, its edge rounded."};

  Point tip{0.0, 0.0, 0.0};                          ///< foremost point of the rounding
  Direction direction{0.0, -1.0, 0.0};               ///< from the tool to the front
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ();  ///< of the edge; z in 2D
  double angle = 0.0;                                ///< degrees, between the flanks
  double radius = 0.0;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const;
  Eigen::Vector3d middle() const { return tip; }
  SurfaceMesh outline(int dim, double reach) const;
};

template <class Visitor>
void describe(Visitor& v, Edge& s) {
  v.field("tip", s.tip, {.required = true, .unit = "length"}, "Foremost point of the rounded tip.");
  v.field("direction", s.direction, {.required = true},
          "Direction from the tool to the front, of any length.");
  v.field("angle", s.angle, {.required = true, .above = 0, .below = 180, .unit = "degrees"},
          "Angle between the flanks.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"}, "Radius of the rounding; sharp when 0.");
  v.field("along", s.along, {}, "Direction along the edge; always z in two dimensions.");
}

void check(const Edge& edge, const ShapeProblems& problems);

}  // namespace burnish::inline tools
