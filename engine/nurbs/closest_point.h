#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// Parameter points of a tensor product at the given shares (0 to 1) of the range of every direction, first
/// direction fastest.
template <int P>
std::vector<Eigen::Vector<double, P>> parameterGrid(const TensorBasis<P>& basis,
                                                    const std::vector<double>& shares);

template <int P>
struct ClosestPoint {
  Eigen::Vector<double, P> xi;
  double distance = 0.0;
};

/// The point of a patch that is closest to a position: Gauss-Newton steps that stay in the patch, from the
/// closest of the starts (at least one), until they are at most `near` from the position. The best of all
/// points on the way, so never farther than a start.
template <int P, int S>
ClosestPoint<P> closestPoint(const Patch<P, S>& patch, const typename Patch<P, S>::Point& position,
                             const std::vector<Eigen::Vector<double, P>>& starts, int maxSteps,
                             double near = 0.0);

}  // namespace burnish::inline nurbs
