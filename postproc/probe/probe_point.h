#pragma once
#include <Eigen/Dense>
#include <limits>

namespace burnish {

/// What a probe finds at a place of its path, or at a time.
struct ProbePoint {
  static constexpr int kOutside = -1;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double at = 0.0;                     ///< distance from the begin of the path, or time
  int body = kOutside;                 ///< number of the body that is there
  Eigen::VectorXd current, reference;  ///< positions of the material there; `kNone` where they are not known
  Eigen::VectorXd values;              ///< one per field; `kNone` outside and in bodies without the field
};

}  // namespace burnish
