#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/schema/coordinates.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/shape_kind.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class ShapeProblems;

/// Box with edges rounded by a radius (0: sharp); a rectangle in 2D, where the third size is infinite.
struct RoundedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();      ///< along its axes, with the rounding
  double radius = 0.0;                                 ///< at most half the smallest size
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns, orthonormal

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const { return 0.5 * size.minCoeff(); }
  Eigen::Vector3d middle() const { return center; }
  SurfaceMesh outline(int dim, double reach) const;
};

/// A rounded box as a scene gives it.
struct BoxTool {
  static constexpr ShapeKind kind{"box", "A box with rounded edges; a rectangle in two dimensions."};

  Point center;
  Direction size;
  double radius = 0.0;
  std::vector<std::vector<double>> axes;  ///< along x, y, z when left out

  RoundedBox made() const;
};

template <class Visitor>
void describe(Visitor& v, BoxTool& s) {
  v.field("center", s.center, {.required = true, .unit = "length"}, "Centre.");
  v.field("size", s.size, {.required = true, .above = 0, .unit = "length"},
          "Lengths of the edges, rounding included.");
  v.field("radius", s.radius, {.atLeast = 0, .unit = "length"},
          "Radius of the rounding of edges and corners, at most half the smallest size; sharp when 0.");
  v.field("axes", s.axes, {},
          "Direction of the first edge, in three dimensions also of the second, which is made perpendicular "
          "to it; along x, y, z when left out.");
}

void check(const BoxTool& box, const ShapeProblems& problems);

}  // namespace burnish::inline tools
