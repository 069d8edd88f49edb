#include "engine/nurbs/closest_point.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace burnish::inline nurbs {
namespace {

template <int P>
Eigen::Vector<double, P> clamped(const TensorBasis<P>& basis, Eigen::Vector<double, P> xi) {
  for (int d = 0; d < P; ++d)
    xi(d) =
        std::clamp(xi(d), basis.direction(d).breakpoints().front(), basis.direction(d).breakpoints().back());
  return xi;
}

}  // namespace

template <int P>
std::vector<Eigen::Vector<double, P>> parameterGrid(const TensorBasis<P>& basis,
                                                    const std::vector<double>& shares) {
  std::size_t total = 1;
  for (int d = 0; d < P; ++d) total *= shares.size();
  std::vector<Eigen::Vector<double, P>> grid(total);
  for (std::size_t k = 0; k < total; ++k) {
    std::size_t rest = k;
    for (int d = 0; d < P; ++d, rest /= shares.size())
      grid[k](d) = basis.direction(d).parameterAt(shares[rest % shares.size()]);
  }
  return grid;
}

template <int P, int S>
ClosestPoint<P> closestPoint(const Patch<P, S>& patch, const typename Patch<P, S>::Point& position,
                             const std::vector<Eigen::Vector<double, P>>& starts, int maxSteps, double near) {
  assert(!starts.empty());
  ClosestPoint<P> best{starts.front(), std::numeric_limits<double>::infinity()};
  const auto visit = [&](const Eigen::Vector<double, P>& xi) {
    const double distance = (position - patch.position(xi)).norm();
    if (distance < best.distance) best = {xi, distance};
  };
  for (const auto& start : starts) visit(start);

  Eigen::Vector<double, P> xi = best.xi;
  for (int step = 0; step < maxSteps && best.distance > near; ++step) {
    // The least-norm solution, because tangents vanish where an edge is collapsed.
    const Eigen::Vector<double, P> increment =
        patch.jacobian(xi).completeOrthogonalDecomposition().solve(position - patch.position(xi));
    const Eigen::Vector<double, P> next = clamped<P>(patch.basis(), xi + increment);
    if (next == xi) break;
    xi = next;
    visit(xi);
  }
  return best;
}

template std::vector<Eigen::Vector<double, 1>> parameterGrid(const TensorBasis<1>&,
                                                             const std::vector<double>&);
template std::vector<Eigen::Vector<double, 2>> parameterGrid(const TensorBasis<2>&,
                                                             const std::vector<double>&);
template std::vector<Eigen::Vector<double, 3>> parameterGrid(const TensorBasis<3>&,
                                                             const std::vector<double>&);
template ClosestPoint<1> closestPoint(const Patch<1, 2>&, const Eigen::Vector2d&,
                                      const std::vector<Eigen::Vector<double, 1>>&, int, double);
template ClosestPoint<2> closestPoint(const Patch<2, 2>&, const Eigen::Vector2d&,
                                      const std::vector<Eigen::Vector2d>&, int, double);
template ClosestPoint<2> closestPoint(const Patch<2, 3>&, const Eigen::Vector3d&,
                                      const std::vector<Eigen::Vector2d>&, int, double);
template ClosestPoint<3> closestPoint(const Patch<3, 3>&, const Eigen::Vector3d&,
                                      const std::vector<Eigen::Vector3d>&, int, double);

}  // namespace burnish::inline nurbs
