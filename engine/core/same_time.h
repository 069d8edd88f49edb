#pragma once
#include <algorithm>
#include <cmath>

namespace burnish::inline core {

/// Whether a time is the one that is wanted, but for the rounding of what adds up steps.
inline bool isSameTime(double time, double wanted) {
  return std::abs(time - wanted) <= 1e-9 * std::max(1.0, std::abs(wanted));
}

}  // namespace burnish::inline core
