#pragma once
#include <Eigen/Dense>

namespace burnish::inline tools {

/// Answer of a rigid surface for a point x: gap g(x) (positive outside the tool), its gradient, which points
/// away from the tool, and its second derivative (symmetric). Where the gap is a distance the gradient is a
/// unit normal; where surfaces are blended it may be shorter.
struct GapQuery {
  double gap = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Matrix3d dNormal = Eigen::Matrix3d::Zero();
  /// In the plane the part of the surface that x sees: where it changes, dNormal jumps. Facets and surfaces in space do not
  /// tell.
  int part = 0;
};

/// The same surface with the body on its other side.
inline GapQuery operator-(const GapQuery& query) {
  return {-query.gap, -query.normal, -query.dNormal, query.part};
}

}  // namespace burnish::inline tools
