#pragma once
#include <numbers>

namespace burnish::inline core {

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

}  // namespace burnish::inline core
