#include "engine/tools/die.h"

#include "engine/tools/outline_parts.h"

namespace burnish::inline tools {

GapQuery Die::query(const Eigen::Vector3d& x) const {
  return -solid.query(x);
}

SurfaceMesh Die::outline(int dim, double reach) const {
  return turnedOver(solid.outline(dim, reach));
}

}  // namespace burnish::inline tools
