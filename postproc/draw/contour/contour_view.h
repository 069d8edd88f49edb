#pragma once
#include <string>
#include <vector>

#include "postproc/draw/page/view.h"

namespace burnish {

/// auto, iso, xy, xz, yz.
const std::vector<std::string>& viewNames();

/// `auto`: of a plane body the plane, of one in space the view from the front, the right and above. `xy`, …:
/// these axes go right and up. `iso`: from the direction (1, 1, 1), y up. Throws `Error` with the nearest
/// name, and for a plane body (dim 2) and a view of anything but its plane.
ViewAxes viewNamed(const std::string& name, int dim);

/// The view of someone in this direction; y goes up unless one looks along it. Throws `Error` for zero.
ViewAxes viewFrom(const Eigen::Vector3d& towardsEye);

}  // namespace burnish
