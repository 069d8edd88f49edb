#include "engine/nurbs/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish {
namespace {

constexpr int kSteps = 50;

/// Radii 1 to 2, angles 0 to 1.
Patch<2> sector() {
  return annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 1.0);
}

Eigen::Vector2d polar(double radius, double angle) {
  return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

TEST(ParameterGrid, RunsThroughSharesOfTheRangesFirstDirectionFastest) {
  const TensorBasis<2> basis(
      {UnivariateBasis::lagrange(1, {0.0, 0.1, 2.0}), UnivariateBasis::lagrange(1, {-1.0, 1.0})});
  const auto grid = parameterGrid(basis, {0.0, 0.5, 1.0});
  ASSERT_EQ(grid.size(), 9U);
  EXPECT_EQ(grid[1], Eigen::Vector2d(1.0, -1.0));
  EXPECT_EQ(grid[3], Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(grid[8], Eigen::Vector2d(2.0, 1.0));
}

TEST(ClosestPoint, OfAPointOfThePatchIsThePointItself) {
  const Patch<2> patch = sector();
  const auto starts = parameterGrid(patch.basis(), {0.0, 0.5, 1.0});
  for (const double radius : {1.0, 1.37, 2.0})
    for (const double angle : {0.0, 0.21, 0.9, 1.0}) {
      const Eigen::Vector2d place = polar(radius, angle);
      const auto closest = closestPoint(patch, place, starts, kSteps);
      EXPECT_LT(closest.distance, 1e-14);
      EXPECT_LT((patch.position(closest.xi) - place).norm(), 1e-14);
      EXPECT_NEAR(closest.xi(0), radius - 1.0, 1e-13);
    }
}

TEST(ClosestPoint, OfACurveIsTheFootOfThePerpendicular) {
  const Patch<1, 2> arc = tracePatch(sector(), faceFromName<2>("right"));
  const auto starts = parameterGrid(arc.basis(), {0.1, 0.5, 0.9});
  for (const double radius : {1.7, 2.2}) {
    const auto closest = closestPoint(arc, polar(radius, 0.3), starts, kSteps);
    EXPECT_NEAR(closest.distance, std::abs(radius - 2.0), 1e-12);
    EXPECT_LT((arc.position(closest.xi) - polar(2.0, 0.3)).norm(), 1e-7);
  }
}

TEST(ClosestPoint, OfASurfaceInSpaceIsTheFootOfThePerpendicular) {
  const Patch<3> shell = sphereSegment({0.0, 0.0, 0.0}, 1.0, 1.5, {0.0, 1.0}, {0.0, 1.0});
  const Patch<2, 3> sphere = tracePatch(shell, faceFromName<3>("right"));
  const Eigen::Vector3d direction = sphere.position({0.4, 0.7}).normalized();
  const auto starts = parameterGrid(sphere.basis(), {0.0, 0.5, 1.0});
  const auto closest = closestPoint<2, 3>(sphere, 1.6 * direction, starts, kSteps);
  EXPECT_NEAR(closest.distance, 0.1, 1e-12);
  EXPECT_LT((closest.xi - Eigen::Vector2d(0.4, 0.7)).norm(), 1e-7);
}

TEST(ClosestPoint, StaysInThePatch) {
  const Patch<1, 2> arc = tracePatch(sector(), faceFromName<2>("right"));
  const auto closest = closestPoint(arc, {3.0, -1.0}, parameterGrid(arc.basis(), {0.5}), kSteps);
  EXPECT_EQ(closest.xi(0), 0.0);
  EXPECT_NEAR(closest.distance, std::sqrt(2.0), 1e-14);
}

TEST(ClosestPoint, IsNeverFartherThanAStart) {
  const Patch<2> patch = sector();
  const auto starts = parameterGrid(patch.basis(), {0.0, 0.5, 1.0});
  const Eigen::Vector2d farAway = polar(9.0, 4.0);
  const auto closest = closestPoint(patch, farAway, starts, kSteps);
  for (const auto& xi : starts) EXPECT_LE(closest.distance, (patch.position(xi) - farAway).norm());
}

TEST(ClosestPoint, IsFoundBesideACollapsedEdge) {
  const Patch<2> square = rectangle({0.0, 0.0}, {1.0, 1.0});
  Eigen::MatrixXd points = square.points();
  points.col(2) = points.col(0);  // the left edge
  const Patch<2> triangle(square.basis(), points, square.weights());
  const auto starts = parameterGrid(triangle.basis(), {0.0, 1.0});
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.3, 0.2)})
    EXPECT_LT(closestPoint(triangle, place, starts, kSteps).distance, 1e-14);
}

}  // namespace
}  // namespace burnish
