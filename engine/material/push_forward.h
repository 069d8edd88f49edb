#pragma once
#include <Eigen/Core>

namespace burnish::inline material {

/// f b f^T: the left Cauchy-Green tensor b after a further deformation f. Rounded the same for every law.
Eigen::Matrix3d pushedForward(const Eigen::Matrix3d& b, const Eigen::Matrix3d& f);

}  // namespace burnish::inline material
