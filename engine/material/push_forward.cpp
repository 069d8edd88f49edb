#include "engine/material/push_forward.h"

namespace burnish::inline material {

Eigen::Matrix3d pushedForward(const Eigen::Matrix3d& b, const Eigen::Matrix3d& f) {
  // Assigned, not returned at once: Eigen sums the two in different orders, and rezoned runs keep their bits
  // with this one.
  Eigen::Matrix3d result = b;
  result = f * b * f.transpose();
  return result;
}

}  // namespace burnish::inline material
