#include "engine/contact/tool.h"

#include <algorithm>

namespace burnish {

Eigen::Vector3d Tool::displacement(double t) const {
  const double moved = std::max(t, 0.0);
  Eigen::Vector3d u(motion[0](moved), motion[1](moved), motion[2](moved));
  if (t < 0.0 && approachTime > 0.0) u += -t / approachTime * lift;
  return u;
}

}  // namespace burnish
