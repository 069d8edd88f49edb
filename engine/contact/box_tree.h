#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

namespace burnish::inline contact {

/// Finds those of many boxes that meet a box.
class BoxTree {
 public:
  BoxTree() = default;

  /// Lowest and highest corners, 3 x n.
  BoxTree(const Eigen::Matrix3Xd& low, const Eigen::Matrix3Xd& high);

  /// Numbers of the boxes that have a point in common with a box, ascending.
  std::vector<int> meeting(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;  ///< null without boxes
};

}  // namespace burnish::inline contact
