#pragma once
#include <Eigen/Dense>

namespace burnish::inline tools {

/// A tool's surface as polylines (2D) or triangles (3D), for drawing.
struct SurfaceMesh {
  Eigen::Matrix3Xd points;
  Eigen::MatrixXi cells;  ///< 2 x segments or 3 x triangles: numbers of points
  bool closed = false;    ///< encloses the tool; otherwise the tool is on one side
};

/// The middle of the box around its points.
inline Eigen::Vector3d middleOfBox(const SurfaceMesh& mesh) {
  return 0.5 * (mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff());
}

}  // namespace burnish::inline tools
