#include "engine/rezoning/inverse_map.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace burnish {
namespace {

constexpr int kMaxSteps = 15;
constexpr double kArrived = 1e-13;  // relative to the size of the patch
constexpr double kInside = 1e-9;
constexpr std::size_t kStarts = 4;

}  // namespace

InverseMap::InverseMap(Patch<2> patch) : patch_(std::move(patch)) {
  size_ = (patch_.points().rowwise().maxCoeff() - patch_.points().rowwise().minCoeff()).maxCoeff();
  const int numSpans = patch_.basis().numSpans();
  parameters_.resize(2, numSpans);
  positions_.resize(2, numSpans);
  for (int span = 0; span < numSpans; ++span) {
    const auto index = patch_.basis().spanIndex(span);
    for (int d = 0; d < 2; ++d) {
      const auto& basis = patch_.basis().direction(d);
      const int e = index[static_cast<std::size_t>(d)];
      parameters_(d, span) = 0.5 * (basis.spanBegin(e) + basis.spanEnd(e));
    }
    positions_.col(span) = patch_.position(parameters_.col(span));
  }
}

Eigen::Vector2d InverseMap::clamped(const Eigen::Vector2d& xi) const {
  Eigen::Vector2d result;
  for (int d = 0; d < 2; ++d) {
    const auto& breakpoints = patch_.basis().direction(d).breakpoints();
    result(d) = std::clamp(xi(d), breakpoints.front(), breakpoints.back());
  }
  return result;
}

InverseMap::Found InverseMap::newton(const Eigen::Vector2d& position, Eigen::Vector2d xi) const {
  Found best{xi, std::numeric_limits<double>::infinity()};
  for (int step = 0; step < kMaxSteps; ++step) {
    const int span = patch_.findSpan(xi);
    const auto shape = patch_.shape(span, xi);
    const auto functions = patch_.basis().spanFunctions(span);
    const Eigen::Vector2d miss = position - patch_.points()(Eigen::all, functions) * shape.R;
    if (miss.norm() < best.distance) best = {xi, miss.norm()};
    if (miss.norm() < kArrived * size_) break;
    const Eigen::Matrix2d jacobian = patch_.points()(Eigen::all, functions) * shape.dR;
    const Eigen::Vector2d next = clamped(xi + jacobian.inverse() * miss);
    if (!next.allFinite() || (next - xi).cwiseAbs().maxCoeff() < kArrived) break;
    xi = next;
  }
  return best;
}

Eigen::Vector2d InverseMap::operator()(const Eigen::Vector2d& position, const Eigen::Vector2d& guess) const {
  Found best = newton(position, guess);
  if (best.distance < kInside * size_) return best.xi;
  const Eigen::VectorXd distances = (positions_.colwise() - position).colwise().squaredNorm();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(distances.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(std::min(kStarts, order.size()));
  std::partial_sort(order.begin(), last, order.end(),
                    [&](Eigen::Index a, Eigen::Index b) { return distances(a) < distances(b); });
  for (auto start = order.begin(); start != last; ++start) {
    const Found found = newton(position, parameters_.col(*start));
    if (found.distance < best.distance) best = found;
    if (best.distance < kInside * size_) break;
  }
  return best.xi;
}

}  // namespace burnish
