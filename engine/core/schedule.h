#pragma once
#include <vector>

namespace burnish::inline core {

/// A piecewise linear function of time, constant before its first and after its last entry.
struct Schedule {
  std::vector<double> times;   ///< strictly increasing
  std::vector<double> values;  ///< one per time

  /// Value at time t; 0 for an empty schedule.
  double operator()(double t) const;
};

/// Whether two schedules have the same value at every time.
bool sameValues(const Schedule& a, const Schedule& b);

}  // namespace burnish::inline core
