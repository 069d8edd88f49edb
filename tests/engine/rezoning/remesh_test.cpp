#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/nurbs/arc_length_curve.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/rezoning/curve_fit.h"
#include "engine/rezoning/mesh_energy.h"
#include "engine/rezoning/remesh.h"
#include "engine/rezoning/span_distribution.h"

namespace burnish {
namespace {

constexpr double kPi = std::numbers::pi;

Patch<2> meshed(const Patch<2>& patch, int degree, int first, int second) {
  return refined(patch, {KnotVector::uniform(degree, first), KnotVector::uniform(degree, second)});
}

/// A slab whose top is a wave, and whose inside follows.
Patch<2> wavy(int degree, int first, int second, double height) {
  const Patch<2> slab = meshed(rectangle({0.0, 0.0}, {3.0, 1.0}), degree, first, second);
  Eigen::MatrixXd points = slab.points();
  for (Eigen::Index a = 0; a < points.cols(); ++a)
    points(1, a) += height * points(1, a) * std::sin(kPi * points(0, a));
  return {slab.basis(), points, slab.weights()};
}

TEST(SpanDistribution, IsFinestInItsIntervalAndGrowsBeyond) {
  const SpanDistribution d = distributeSpans(3.0, {1.0, 1.5}, 40, {0.25, 0.03});
  ASSERT_EQ(d.breakpoints.size(), 41u);
  EXPECT_EQ(d.breakpoints.front(), 0.0);
  EXPECT_EQ(d.breakpoints.back(), 1.0);
  for (std::size_t k = 1; k < d.breakpoints.size(); ++k) {
    const double begin = 3.0 * d.breakpoints[k - 1], end = 3.0 * d.breakpoints[k], size = end - begin;
    EXPECT_GT(size, 0.0);
    if (begin > 1.0 && end < 1.5) {
      EXPECT_NEAR(size, d.smallest, 0.01 * d.smallest);
    }
    if (begin > 1.5) {
      const double middle = 0.5 * (begin + end) - 1.5;
      EXPECT_NEAR(size, d.smallest + 0.25 * (std::hypot(middle, 0.03) - 0.03), 0.05 * size);
    }
  }
}

TEST(SpanDistribution, IsEvenWhereEverythingIsFinest) {
  const SpanDistribution d = distributeSpans(2.0, {-1.0, 3.0}, 8, {0.25, 0.03});
  for (std::size_t k = 0; k < d.breakpoints.size(); ++k)
    EXPECT_NEAR(d.breakpoints[k], static_cast<double>(k) / 8.0, 1e-9);
}

TEST(SpanDistribution, ObeysALimitWhereThereAreSpansEnough) {
  std::vector<double> limits(301, 1.0);
  for (std::size_t k = 199; k <= 221; ++k) limits[k] = 0.05;  // from 1.99 to 2.21
  const SpanDistribution d = distributeSpans(3.0, {0.5, 0.7}, 60, {0.25, 0.03}, limits);
  for (std::size_t k = 1; k < d.breakpoints.size(); ++k)
    if (3.0 * d.breakpoints[k - 1] > 2.0 && 3.0 * d.breakpoints[k] < 2.2) {
      EXPECT_LT(3.0 * (d.breakpoints[k] - d.breakpoints[k - 1]), 0.0501);
    }
}

/// Limits of no size at all around a place on a length of 3.
SpanDistribution withLimitAt(std::size_t place) {
  std::vector<double> limits(301, 3.0);
  for (std::size_t k = place - 10; k <= place + 10; ++k) limits[k] = 1e-6;
  return distributeSpans(3.0, {0.5, 1.5}, 60, {0.25, 0.03}, limits);
}

TEST(SpanDistribution, MakesSpansForALimitHalfAsLargeAsTheFinestAndNotLess) {
  const SpanDistribution inside = withLimitAt(100), beyond = withLimitAt(220);
  EXPECT_NEAR(inside.smallest, 0.5 * inside.finest, 1e-2 * inside.finest);
  EXPECT_NEAR(beyond.smallest, beyond.finest, 1e-2 * beyond.finest);
  const double free = distributeSpans(3.0, {0.5, 1.5}, 60, {0.25, 0.03}).finest;
  EXPECT_GT(inside.finest, free);
  EXPECT_GT(beyond.finest, free);
}

TEST(SpanDistribution, LayersBeginAsAskedAndGrowByOneRatio) {
  const auto layers = distributeLayers(1.0, 0.02, 20);
  ASSERT_EQ(layers.size(), 21u);
  EXPECT_NEAR(layers[1], 0.02, 1e-10);
  const double ratio = (layers[2] - layers[1]) / layers[1];
  for (std::size_t k = 2; k < layers.size(); ++k)
    EXPECT_NEAR((layers[k] - layers[k - 1]) / (layers[k - 1] - layers[k - 2]), ratio, 1e-9);
  const auto even = distributeLayers(1.0, 0.5, 4);
  EXPECT_NEAR(even[1], 0.25, 1e-14);
  EXPECT_THROW(distributeLayers(0.0, 0.1, 3), Error);
}

TEST(CurveFit, ReproducesStraightLinesAndConvergesOnACircle) {
  const UnivariateBasis basis = UnivariateBasis::bspline(KnotVector(2, {0, 0, 0, 0.1, 0.4, 1, 1, 1}));
  const Patch<2> slab = meshed(rectangle({0.0, 0.0}, {3.0, 1.0}), 2, 7, 2);
  EXPECT_LT(fitCurve(ArcLengthCurve(tracePatch(slab, 3)), basis).normalError, 1e-14);

  const ArcLengthCurve circle(tracePatch(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 0.5 * kPi), 1));
  for (const int degree : {2, 3}) {
    const auto errorWith = [&](int spans) {
      return fitCurve(circle, UnivariateBasis::bspline(KnotVector::uniform(degree, spans))).normalError;
    };
    EXPECT_GT(std::log2(errorWith(8) / errorWith(16)), degree + 0.7);
  }
}

TEST(MeshEnergy, LeavesARectangleAloneAndUntanglesASkewedInside) {
  Patch<2> slab = meshed(rectangle({0.0, 0.0}, {2.0, 1.0}), 2, 6, 4);
  Eigen::MatrixXd points = slab.points();
  for (int a = 0; a < slab.basis().numFunctions(); ++a) {
    const auto index = slab.basis().functionIndex(a);
    if (index[0] > 0 && index[0] < 7 && index[1] > 0 && index[1] < 5) points(0, a) += 0.04 * index[1];
  }
  const auto relaxedMesh = relaxed(Patch<2>(slab.basis(), points, slab.weights()), {2.0, 1.0}, 3);
  ASSERT_TRUE(relaxedMesh);
  EXPECT_LT((relaxedMesh->points() - slab.points()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Remesh, KeepsTheBoundaryAndPutsFineSpansWhereTheyAreWanted) {
  const Patch<2> body = wavy(2, 20, 8, 0.2);
  RemeshOptions options;
  options.finest = {1.0, 1.3};
  options.spans = {40, 16};
  options.rounding = 0.03;
  options.mesh.turn = 0.2;
  const auto meshing = remesh(body, options);
  ASSERT_TRUE(meshing);
  EXPECT_LT(meshing->boundaryError, 5e-4);
  EXPECT_GT(meshing->quality, 0.3);
  EXPECT_DOUBLE_EQ(meshing->quality, meshQuality(meshing->patch));
  EXPECT_EQ(meshing->patch.basis().direction(0).numSpans(), 40);
  EXPECT_EQ(meshing->patch.basis().direction(1).numSpans(), 16);
  const ArcLengthCurve top(tracePatch(meshing->patch, 3));
  EXPECT_NEAR(top.length(), ArcLengthCurve(tracePatch(body, 3)).length(), 1e-3);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1)})
    EXPECT_LT((meshing->patch.position(corner) - body.position(corner)).norm(), 1e-13);

  options.spans = {80, 32};
  options.mesh.turn = 0.1;
  EXPECT_LT(remesh(body, options)->boundaryError, 0.7 * meshing->boundaryError);
}

TEST(Remesh, WorksFromAnyFaceAndWithLagrangeElements) {
  const Patch<2> slab = meshed(rectangle({0.0, 0.0}, {3.0, 1.0}), 2, 6, 6);
  for (FaceId face = 0; face < 4; ++face) {
    RemeshOptions options{
        .face = face, .finest = {0.3, 0.4}, .spans = {12, 12}, .rounding = 0.03, .mesh = {.turn = 0.0}};
    const auto meshing = remesh(slab, options);
    ASSERT_TRUE(meshing);
    // The first layer is one and a half times as deep as the finest spans are long.
    const auto& across = meshing->patch.basis().direction(face / 2);
    const double depth = face / 2 == 0 ? 3.0 : 1.0;
    const double first = face % 2 == 0 ? across.spanEnd(0) : 1.0 - across.spanBegin(across.numSpans() - 1);
    EXPECT_NEAR(first * depth, std::min(1.5 * meshing->smallestSpan, depth / 12.0), 1e-9);
  }
  const Patch<2> elements = lagrangeInterpolant(slab, 2, {{0.0, 0.5, 1.0}, {0.0, 0.5, 1.0}});
  const auto meshing =
      remesh(elements, {.finest = {1.0, 1.2}, .spans = {6, 3}, .rounding = 0.03, .mesh = {.turn = 0.0}});
  ASSERT_TRUE(meshing);
  EXPECT_EQ(meshing->patch.basis().direction(0).family(), BasisFamily::Lagrange);
  EXPECT_EQ(meshing->patch.basis().direction(0).numFunctions(), 13);
}

TEST(Remesh, RefusesAMeshThatIsFolded) {
  Patch<2> slab = meshed(rectangle({0.0, 0.0}, {3.0, 1.0}), 1, 2, 1);
  Eigen::MatrixXd points = slab.points();
  points.col(4) = Eigen::Vector2d(1.5, -0.5);  // the middle of the top is below the bottom
  EXPECT_FALSE(remesh(Patch<2>(slab.basis(), points, slab.weights()),
                      {.finest = {1.0, 1.2}, .spans = {8, 4}, .rounding = 0.03, .mesh = {.turn = 0.0}}));
}

}  // namespace
}  // namespace burnish
