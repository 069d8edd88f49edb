#include "engine/nurbs/inverse_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish {
namespace {

template <int Dim>
Patch<Dim> meshed(const Patch<Dim>& patch, const std::array<int, Dim>& spans) {
  std::vector<KnotVector> knots;
  for (const int count : spans) knots.push_back(KnotVector::uniform(2, count));
  return refined(patch, knots);
}

/// The patch with control points moved by up to `size` in every direction, in waves.
template <int Dim>
Patch<Dim> wavy(const Patch<Dim>& patch, double size) {
  Eigen::MatrixXd points = patch.points();
  for (Eigen::Index a = 0; a < points.cols(); ++a)
    for (int d = 0; d < Dim; ++d) points(d, a) += size * std::sin(2.0 * patch.points()((d + 1) % Dim, a) + d);
  return {patch.basis(), points, patch.weights()};
}

/// From one guess, at shares of the parameters that no grid has.
template <int Dim>
void expectAllFound(const Patch<Dim>& patch) {
  const InverseMap<Dim> map(patch);
  const Eigen::Vector<double, Dim> guess = patch.basis().anchor(0);
  for (const auto& xi : parameterGrid(patch.basis(), {0.0, 0.11, 0.37, 0.62, 0.83, 1.0})) {
    const auto found = map(patch.position(xi), guess);
    EXPECT_TRUE(map.arrived(found)) << xi.transpose() << ", distance " << found.distance;
  }
}

TEST(InverseMap, FindsParametersAndEndsOnTheBoundaryFromOutside) {
  const Patch<2> ring = meshed<2>(annulus({0.0, 0.0}, 1.0, 2.0, 0.3, 1.2), {3, 5});
  const InverseMap<2> map(ring);
  for (const Eigen::Vector2d& xi :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.21, 0.93), Eigen::Vector2d(1.0, 0.4)})
    EXPECT_LT((map(ring.position(xi), {0.5, 0.5}).xi - xi).norm(), 1e-10);
  const auto outside = map(1.01 * ring.position({1.0, 0.37}), {0.9, 0.1});
  EXPECT_EQ(outside.xi(0), 1.0);
  EXPECT_NEAR(outside.xi(1), 0.37, 1e-9);
  EXPECT_NEAR(outside.distance, 0.02, 1e-9);
}

TEST(InverseMap, ArrivesFromAFarGuessInThePlaneAndInSpace) {
  expectAllFound<2>(meshed<2>(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 0.9 * std::numbers::pi), {2, 8}));
  expectAllFound<2>(wavy<2>(meshed<2>(rectangle({0.0, 0.0}, {8.0, 0.5}), {16, 3}), 0.6));
  expectAllFound<2>(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 0.5 * std::numbers::pi));
  expectAllFound<2>(disc({0.0, 0.0}, 1.0, 0.0));
  expectAllFound<3>(wavy<3>(meshed<3>(box({0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}), {5, 3, 2}), 0.15));
  expectAllFound<3>(cylinderSegment({0.0, 0.0, 0.0}, 1.0, 1.2, 0.0, 2.5, 3.0));
}

}  // namespace
}  // namespace burnish
