#include "engine/rezoning/grid_interpolation.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace burnish {
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

}  // namespace

GridInterpolation::GridInterpolation(std::array<std::vector<double>, 2> coordinates, Eigen::MatrixXd values)
    : coordinates_(std::move(coordinates)), values_(std::move(values)) {
  assert(coordinates_[0].size() >= 2 && coordinates_[1].size() >= 2);
  assert(values_.cols() == std::ssize(coordinates_[0]) * std::ssize(coordinates_[1]));
}

GridInterpolation::Stencil GridInterpolation::stencil(const std::vector<double>& coordinates, double x) {
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

Eigen::VectorXd GridInterpolation::operator()(const Eigen::Vector2d& xi) const {
  const std::array<Stencil, 2> stencils{stencil(coordinates_[0], xi(0)), stencil(coordinates_[1], xi(1))};
  const auto stride = std::ssize(coordinates_[0]);
  const auto rows = std::ssize(coordinates_[1]);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(values_.rows());
  for (Eigen::Index b = 0; b < stencils[1].weights.size(); ++b)
    result +=
        stencils[1].weights(b) * (values_.middleCols((stencils[1].first + b) * stride + stencils[0].first,
                                                     stencils[0].weights.size()) *
                                  stencils[0].weights);
  if (!stencils[0].inside || !stencils[1].inside) return result;

  Eigen::VectorXd low = values_.col(stencils[1].nearest * stride + stencils[0].nearest), high = low;
  for (Eigen::Index b = std::max(0, stencils[1].nearest - 1);
       b <= std::min<Eigen::Index>(rows - 1, stencils[1].nearest + 1); ++b)
    for (Eigen::Index a = std::max(0, stencils[0].nearest - 1);
         a <= std::min<Eigen::Index>(stride - 1, stencils[0].nearest + 1); ++a) {
      low = low.cwiseMin(values_.col(b * stride + a));
      high = high.cwiseMax(values_.col(b * stride + a));
    }
  return result.cwiseMax(low).cwiseMin(high);
}

}  // namespace burnish
