#pragma once
#include <Eigen/Dense>

#include "engine/tools/gap_query.h"
#include "engine/tools/rigid_shape.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// The tool fills the space around a solid, the body is in the hollow.
struct Die {
  RigidShape solid;

  GapQuery query(const Eigen::Vector3d& x) const;
  double halfThickness() const { return solid.halfThicknessOfDie(); }
  double bulge() const { return solid.bulge(); }
  Eigen::Vector3d middle() const { return solid.middle(); }
  SurfaceMesh outline(int dim, double reach) const;
};

/// Of the key `inside`.
inline constexpr const char* kInsideSentence =
    "The tool fills the space around the shape, and the body is in the hollow: a die.";

}  // namespace burnish::inline tools
