#pragma once
#include <Eigen/Dense>
#include <memory>

namespace burnish::inline tools {

/// Finds the segment or triangle of a surface that is nearest to a point.
class FacetTree {
 public:
  struct Hit {
    int cell = 0;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the cell, nearest to the asked one
  };

  /// points: 3 x n; cells: 2 x m segments or 3 x m triangles, m > 0, none of them degenerate.
  FacetTree(const Eigen::Matrix3Xd& points, const Eigen::MatrixXi& cells);

  Hit nearest(const Eigen::Vector3d& x) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace burnish::inline tools
