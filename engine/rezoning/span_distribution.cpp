#include "engine/rezoning/span_distribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/core/error.h"

namespace burnish::inline rezoning {
namespace {

constexpr int kIntervals = 4000;
constexpr int kHalvings = 60;

/// Part of h_0 below which no limit makes a span of the interval that is to be finest.
constexpr double kSmallestShare = 0.5;

/// Sizes of spans at the middles of many even intervals.
class Sizes {
 public:
  Sizes(double length, const ArcInterval& finest, const SpanGrowth& growth, const std::vector<double>& limits)
      : step_(length / kIntervals),
        slope_(growth.slope),
        growths_(kIntervals),
        smallest_(kIntervals),
        limits_(kIntervals, length) {
    for (std::size_t k = 0; k < kIntervals; ++k) {
      const double s = (static_cast<double>(k) + 0.5) * step_;
      const double d = std::max({finest.begin - s, s - finest.end, 0.0});
      smallest_[k] = d == 0.0 ? kSmallestShare : 1.0;
      growths_[k] = slope_ * (std::hypot(d, growth.rounding) - growth.rounding);
      if (limits.empty()) continue;
      const double place = s / length * (static_cast<double>(limits.size()) - 1.0);
      const auto below = static_cast<std::size_t>(place);
      limits_[k] =
          std::lerp(limits[below], limits[std::min(below + 1, limits.size() - 1)], place - std::floor(place));
    }
  }

  /// ∫ ds/h up to the end of each interval.
  std::vector<double> spansUpTo(double finest) const {
    std::vector<double> sizes(kIntervals);
    for (std::size_t k = 0; k < kIntervals; ++k)
      sizes[k] = std::min(finest + growths_[k], std::max(smallest_[k] * finest, limits_[k]));
    for (std::size_t k = 1; k < kIntervals; ++k) sizes[k] = std::min(sizes[k], sizes[k - 1] + slope_ * step_);
    for (std::size_t k = kIntervals - 1; k-- > 0;)
      sizes[k] = std::min(sizes[k], sizes[k + 1] + slope_ * step_);
    std::vector<double> counts{0.0};
    for (const double size : sizes) counts.push_back(counts.back() + step_ / size);
    return counts;
  }

 private:
  double step_, slope_;
  std::vector<double> growths_, smallest_, limits_;
};

}  // namespace

SpanDistribution distributeSpans(double length, const ArcInterval& finest, int numSpans,
                                 const SpanGrowth& growth, const std::vector<double>& limits) {
  if (!(length > 0.0) || numSpans < 1)
    throw Error("knot spans are distributed over a positive length, and at least one of them");
  const Sizes sizes(length, finest, growth, limits);
  double low = 0.0, high = length / numSpans;  // equal spans are the largest h_0
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (sizes.spansUpTo(middle).back() > numSpans ? low : high) = middle;
  }

  SpanDistribution result{{0.0}, high, length};
  const std::vector<double> counts = sizes.spansUpTo(high);
  for (int k = 1; k < numSpans; ++k) {
    const double wanted = counts.back() * k / numSpans;
    const auto above = std::upper_bound(counts.begin(), counts.end(), wanted);
    const double share = (wanted - *(above - 1)) / (*above - *(above - 1));
    result.breakpoints.push_back((static_cast<double>(above - counts.begin()) - 1.0 + share) / kIntervals);
  }
  result.breakpoints.push_back(1.0);
  for (std::size_t k = 1; k < result.breakpoints.size(); ++k)
    result.smallest = std::min(result.smallest, length * (result.breakpoints[k] - result.breakpoints[k - 1]));
  return result;
}

std::vector<double> distributeLayers(double depth, double first, int numSpans) {
  if (!(depth > 0.0) || numSpans < 1)
    throw Error("knot spans are distributed over a positive depth, and at least one of them");
  const auto total = [&](double ratio) {
    double sum = 0.0, size = first;
    for (int k = 0; k < numSpans; ++k, size *= ratio) sum += size;
    return sum;
  };
  double ratio = 1.0;
  if (total(1.0) < depth) {
    double high = 2.0;
    while (total(high) < depth) high *= 2.0;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (ratio + high);
      (total(middle) < depth ? ratio : high) = middle;
    }
  }
  std::vector<double> breakpoints{0.0};
  double size = 1.0;
  for (int k = 0; k < numSpans; ++k, size *= ratio) breakpoints.push_back(breakpoints.back() + size);
  for (double& breakpoint : breakpoints) breakpoint /= breakpoints.back();
  return breakpoints;
}

}  // namespace burnish::inline rezoning
