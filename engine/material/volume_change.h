#pragma once
#include <Eigen/Core>

namespace burnish::inline material {

/// Determinant of a deformation gradient, split so that nothing cancels near the undeformed state.
struct VolumeChange {
  double trace;   ///< tr H with H = F − I
  double higher;  ///< J − 1 − tr H: the second and third invariant of H

  explicit VolumeChange(const Eigen::Matrix3d& H)
      : trace(H.trace()),
        higher(H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0) + H(1, 1) * H(2, 2) - H(1, 2) * H(2, 1) +
               H(2, 2) * H(0, 0) - H(2, 0) * H(0, 2) + determinant(H)) {}

  double minusOne() const { return trace + higher; }  ///< J − 1
  double J() const { return 1.0 + minusOne(); }

 private:
  static double determinant(const Eigen::Matrix3d& H) {
    return H(0, 0) * (H(1, 1) * H(2, 2) - H(1, 2) * H(2, 1)) +
           H(0, 1) * (H(1, 2) * H(2, 0) - H(1, 0) * H(2, 2)) +
           H(0, 2) * (H(1, 0) * H(2, 1) - H(1, 1) * H(2, 0));
  }
};

}  // namespace burnish::inline material
