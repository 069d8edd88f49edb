#include "engine/nurbs/inverse_map.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace burnish::inline nurbs {
namespace {

constexpr int kMaxSteps = 15;
constexpr double kArrived = 1e-13;  // relative to the size of the patch
constexpr double kInside = 1e-9;
constexpr std::size_t kStarts = 4;

}  // namespace

template <int Dim>
InverseMap<Dim>::InverseMap(Patch<Dim> patch)
    : patch_(std::move(patch)),
      size_((patch_.points().rowwise().maxCoeff() - patch_.points().rowwise().minCoeff()).maxCoeff()) {
  for (int span = 0; span < patch_.basis().numSpans(); ++span) {
    const auto index = patch_.basis().spanIndex(span);
    Point middle;
    for (int d = 0; d < Dim; ++d) {
      const auto& basis = patch_.basis().direction(d);
      const int e = index[static_cast<std::size_t>(d)];
      middle(d) = 0.5 * (basis.spanBegin(e) + basis.spanEnd(e));
    }
    samples_.push_back({middle, patch_.position(middle)});
  }
}

template <int Dim>
ClosestPoint<Dim> InverseMap<Dim>::operator()(const Point& position, const Point& guess) const {
  ClosestPoint<Dim> best = closestPoint<Dim, Dim>(patch_, position, {guess}, kMaxSteps, kArrived * size_);
  if (arrived(best)) return best;
  std::vector<std::size_t> order(samples_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(std::min(kStarts, order.size()));
  std::partial_sort(order.begin(), last, order.end(), [&](std::size_t a, std::size_t b) {
    return (samples_[a].position - position).squaredNorm() < (samples_[b].position - position).squaredNorm();
  });
  for (auto start = order.begin(); start != last && !arrived(best); ++start) {
    const auto found =
        closestPoint<Dim, Dim>(patch_, position, {samples_[*start].xi}, kMaxSteps, kArrived * size_);
    if (found.distance < best.distance) best = found;
  }
  return best;
}

template <int Dim>
bool InverseMap<Dim>::arrived(const ClosestPoint<Dim>& found) const {
  return found.distance < kInside * size_;
}

template class InverseMap<2>;
template class InverseMap<3>;

}  // namespace burnish::inline nurbs
