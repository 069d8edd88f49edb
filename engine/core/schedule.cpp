#include "engine/core/schedule.h"

#include <algorithm>

namespace burnish::inline core {

double Schedule::operator()(double t) const {
  if (times.empty()) return 0.0;
  if (t <= times.front()) return values.front();
  if (t >= times.back()) return values.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin());
  const double s = (t - times[k - 1]) / (times[k] - times[k - 1]);
  return (1.0 - s) * values[k - 1] + s * values[k];
}

bool sameValues(const Schedule& a, const Schedule& b) {
  // Piecewise linear functions are equal when they are equal at the corners of both.
  const auto agree = [&](double t) { return a(t) == b(t); };
  return std::all_of(a.times.begin(), a.times.end(), agree) &&
         std::all_of(b.times.begin(), b.times.end(), agree);
}

}  // namespace burnish::inline core
