#include "engine/fields/percentile_measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burnish::inline fields {

double weightedPercentile(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, double share) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values(a) < values(b); });
  // A value stands for the middle of its weight.
  const double wanted = share * weights.sum();
  double below = 0.0, placeBefore = 0.0, valueBefore = values(order.front());
  for (const Eigen::Index k : order) {
    const double place = below + 0.5 * weights(k);
    if (place >= wanted)
      return place > placeBefore
                 ? std::lerp(valueBefore, values(k), (wanted - placeBefore) / (place - placeBefore))
                 : values(k);
    below += weights(k);
    placeBefore = place;
    valueBefore = values(k);
  }
  return valueBefore;
}

std::vector<double> PercentileMeasure::values(const MeasuredState&) const {
  return {weightedPercentile(field_(), volumes_(), share_)};
}

}  // namespace burnish::inline fields
