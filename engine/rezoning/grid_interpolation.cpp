#include "engine/rezoning/grid_interpolation.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace burnish::inline rezoning {
namespace {

/// Lagrange polynomials of the coordinates first … first + n - 1 at x.
Eigen::VectorXd lagrangeWeights(const std::vector<double>& coordinates, int first, int n, double x) {
  const double* c = coordinates.data() + first;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      if (a != b) weights(a) *= (x - c[b]) / (c[a] - c[b]);
  return weights;
}

/// Calls f with every index from `first` to `last`, the first direction fastest.
template <std::size_t P, class F>
void forEachIndex(const std::array<int, P>& first, const std::array<int, P>& last, const F& f) {
  std::array<int, P> index = first;
  for (std::size_t d = 0; d < P;) {
    f(index);
    for (d = 0; d < P && ++index[d] > last[d]; ++d) index[d] = first[d];
  }
}

}  // namespace

template <int P>
GridInterpolation<P>::GridInterpolation(std::array<std::vector<double>, P> coordinates,
                                        Eigen::MatrixXd values)
    : coordinates_(std::move(coordinates)), values_(std::move(values)) {
  [[maybe_unused]] Eigen::Index points = 1;
  for (const auto& direction : coordinates_) {
    assert(direction.size() >= 2);
    points *= std::ssize(direction);
  }
  assert(values_.cols() == points);
}

template <int P>
typename GridInterpolation<P>::Stencil GridInterpolation<P>::stencil(const std::vector<double>& coordinates,
                                                                     double x) {
  const int n = static_cast<int>(coordinates.size());
  const auto above = std::upper_bound(coordinates.begin(), coordinates.end(), x);
  const int interval = std::clamp(static_cast<int>(above - coordinates.begin()) - 1, 0, n - 2);
  const auto at = [&](int k) { return coordinates[static_cast<std::size_t>(k)]; };
  Stencil stencil;
  stencil.nearest = x - at(interval) < at(interval + 1) - x ? interval : interval + 1;
  stencil.inside = x >= coordinates.front() && x <= coordinates.back();
  const int points = stencil.inside ? std::min(4, n) : 2;
  stencil.first = std::clamp(interval - (points - 2) / 2, 0, n - points);
  stencil.weights = lagrangeWeights(coordinates, stencil.first, points, x);
  return stencil;
}

template <int P>
Eigen::Index GridInterpolation<P>::place(const std::array<int, P>& index) const {
  Eigen::Index place = 0;
  for (std::size_t d = P; d-- > 0;) place = place * std::ssize(coordinates_[d]) + index[d];
  return place;
}

template <int P>
Eigen::VectorXd GridInterpolation<P>::operator()(const Eigen::Vector<double, P>& xi) const {
  std::array<Stencil, P> stencils;
  std::array<int, P> first{}, last{}, low{}, high{};
  bool inside = true;
  for (std::size_t d = 0; d < P; ++d) {
    const Stencil& along = stencils[d] = stencil(coordinates_[d], xi(static_cast<Eigen::Index>(d)));
    const int n = static_cast<int>(coordinates_[d].size());
    first[d] = along.first;
    last[d] = along.first + static_cast<int>(along.weights.size()) - 1;
    low[d] = std::max(0, along.nearest - 1);
    high[d] = std::min(n - 1, along.nearest + 1);
    inside = inside && along.inside;
  }
  last[0] = first[0];  // lines along the first direction
  Eigen::VectorXd result = Eigen::VectorXd::Zero(values_.rows());
  forEachIndex(first, last, [&](const std::array<int, P>& index) {
    double weight = stencils[1].weights(index[1] - first[1]);
    for (std::size_t d = 2; d < P; ++d) weight *= stencils[d].weights(index[d] - first[d]);
    result += weight * (values_.middleCols(place(index), stencils[0].weights.size()) * stencils[0].weights);
  });
  if (!inside) return result;

  Eigen::VectorXd least = values_.col(place(low)), most = least;
  forEachIndex(low, high, [&](const std::array<int, P>& index) {
    least = least.cwiseMin(values_.col(place(index)));
    most = most.cwiseMax(values_.col(place(index)));
  });
  return result.cwiseMax(least).cwiseMin(most);
}

template class GridInterpolation<2>;
template class GridInterpolation<3>;

}  // namespace burnish::inline rezoning
