#include "engine/nurbs/patch.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"

namespace burnish {
namespace {

constexpr double kPi = std::numbers::pi;

template <int P>
Eigen::Vector<double, P> randomParameter(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  return Eigen::Vector<double, P>::NullaryExpr([&] { return uniform(generator); });
}

/// Largest distance between two patches over random parameters.
template <int P, int S>
double distance(const Patch<P, S>& a, const Patch<P, S>& b) {
  std::mt19937 generator(3);
  double largest = 0.0;
  for (int k = 0; k < 200; ++k) {
    const auto xi = randomParameter<P>(generator);
    largest = std::max(largest, (a.position(xi) - b.position(xi)).norm());
  }
  return largest;
}

TEST(Shapes, AnnulusLiesOnItsCircles) {
  const auto ring = annulus({0.3, -0.2}, 1.0, 2.5, 0.2, 1.9);
  std::mt19937 generator(1);
  for (int k = 0; k < 100; ++k) {
    const auto xi = randomParameter<2>(generator);
    const Eigen::Vector2d v = ring.position(xi) - Eigen::Vector2d(0.3, -0.2);
    EXPECT_NEAR(v.norm(), 1.0 + 1.5 * xi(0), 1e-14 * 4);
  }
  EXPECT_NEAR((ring.position({0.0, 1.0}) - Eigen::Vector2d(0.3 + std::cos(2.1), -0.2 + std::sin(2.1))).norm(),
              0.0, 1e-14);
}

TEST(Shapes, CylinderAndSphereSegmentsAreExact) {
  const auto tube = cylinderSegment({1.0, 2.0, 3.0}, 0.5, 1.0, 0.1, 1.5, 2.0);
  const auto shell = sphereSegment({1.0, 2.0, 3.0}, 0.5, 1.0, {0.0, kPi / 2}, {-0.4, kPi / 3});
  std::mt19937 generator(2);
  for (int k = 0; k < 100; ++k) {
    const auto xi = randomParameter<3>(generator);
    const Eigen::Vector3d t = tube.position(xi) - Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_NEAR(t.head<2>().norm(), 0.5 + 0.5 * xi(0), 1e-14 * 4);
    EXPECT_NEAR(t(2), 2.0 * xi(2), 1e-14 * 4);
    const Eigen::Vector3d s = shell.position(xi) - Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_NEAR(s.norm(), 0.5 + 0.5 * xi(0), 1e-14 * 4);
    EXPECT_GT(shell.jacobian(xi).determinant(), 0.0);
    EXPECT_GT(tube.jacobian(xi).determinant(), 0.0);
  }
}

/// Smallest determinant of the map over random parameters.
double smallestDeterminant(const Patch<3>& patch) {
  std::mt19937 generator(4);
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2000; ++k)
    smallest = std::min(smallest, patch.jacobian(randomParameter<3>(generator)).determinant());
  return smallest;
}

/// Largest distance of a face from the sphere or, with a unit axis, from the cylinder of radius 1 about
/// `center`.
double distanceFromRound(const Patch<3>& patch, const char* face, const Eigen::Vector3d& center,
                         const Eigen::Vector3d& axis = Eigen::Vector3d::Zero()) {
  const auto trace = tracePatch(patch, faceFromName<3>(face));
  std::mt19937 generator(5);
  double largest = 0.0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector3d v = trace.position(randomParameter<2>(generator)) - center;
    largest = std::max(largest, std::abs((v - v.dot(axis) * axis).norm() - 1.0));
  }
  return largest;
}

TEST(Shapes, SolidCylindersAreRoundAndNowhereFolded) {
  const Eigen::Vector3d begin(1.0, 2.0, 3.0), axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const auto whole = swept(disc({0.0, 0.0}, 1.0, 0.3), begin, 4.0 * axis, 2.0);
  for (const char* face : {"left", "right", "bottom", "top"})
    EXPECT_LT(distanceFromRound(whole, face, begin, axis), 1e-14) << face;
  EXPECT_GT(smallestDeterminant(whole), 0.0);
  EXPECT_NEAR((whole.position({0.5, 0.5, 1.0}) - begin - 2.0 * axis).norm(), 0.0, 1e-14);
  for (const double opening : {0.2, kPi / 2, 3.0}) {
    const auto sector = swept(discSector({0.0, 0.0}, 1.0, 0.3, opening), begin, axis, 2.0);
    for (const char* face : {"right", "top"})
      EXPECT_LT(distanceFromRound(sector, face, begin, axis), 1e-14) << face;
    EXPECT_GT(smallestDeterminant(sector), 0.0) << opening;
  }
}

TEST(Shapes, TheAxisSaysWhereAnglesBegin) {
  const Patch<2> ring = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, kPi / 2);
  for (int d = 0; d < 3; ++d) {
    const auto tube = swept(ring, Eigen::Vector3d::Zero(), 3.0 * Eigen::Vector3d::Unit(d), 1.0);
    EXPECT_LT((tube.position({0.0, 0.0, 0.0}) - Eigen::Vector3d::Unit((d + 1) % 3)).norm(), 1e-15);
    EXPECT_LT((tube.position({0.0, 1.0, 0.0}) - Eigen::Vector3d::Unit((d + 2) % 3)).norm(), 1e-15);
  }
}

TEST(Shapes, BallOctantHasItsPoleAtARegularCornerOfTheSphere) {
  const Eigen::Vector3d center(1.0, 2.0, 3.0);
  const auto ball = ballOctant(center, 1.0, {0.0, 0.0, -5.0});
  EXPECT_LT(distanceFromRound(ball, "right", center), 1e-14);
  EXPECT_GT(smallestDeterminant(ball), 0.0);
  EXPECT_LT((ball.position({1.0, 0.0, 0.0}) - center + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_NEAR((ball.position({0.5, 1.0, 0.5}) - center)(2), 0.0, 1e-15)
      << "top is the plane through the centre";
  const Eigen::Matrix3d atPole = ball.jacobian({1.0, 0.0, 0.0});
  EXPECT_NEAR(atPole.col(1).normalized().dot(atPole.col(2).normalized()), 0.0, 1e-14);
  EXPECT_NEAR(atPole.col(1).norm(), std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(atPole.col(2).norm(), std::sqrt(2.0), 1e-14);
}

TEST(Shapes, ImpossibleOnesAreRefused) {
  EXPECT_THROW(disc({0, 0}, 0.0, 0.0), Error);
  EXPECT_THROW(discSector({0, 0}, -1.0, 0.0, 1.0), Error);
  EXPECT_THROW(swept(disc({0, 0}, 1.0, 0.0), {0, 0, 0}, {0, 0, 1}, 0.0), Error);
  EXPECT_THROW(ballOctant({0, 0, 0}, 1.0, {0, 0, 0}), Error);
  EXPECT_THROW(annulus({0, 0}, 0.0, 1.0, 0.0, 1.0), Error);
  EXPECT_THROW(annulus({0, 0}, 2.0, 1.0, 0.0, 1.0), Error);
  EXPECT_THROW(annulus({0, 0}, 1.0, 2.0, 0.0, kPi), Error);
  EXPECT_THROW(rectangle({0, 0}, {1.0, 0.0}), Error);
  EXPECT_THROW(box({0, 0, 0}, {1.0, 1.0, -1.0}), Error);
}

TEST(Refinement, LeavesTheGeometryUnchanged) {
  const auto ring = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, kPi / 2);
  const auto radial = KnotVector(1, {0, 0, 1, 1}), angular = KnotVector(2, {0, 0, 0, 1, 1, 1});
  const auto inserted = refined(ring, {withKnots(radial, {0.3, 0.6}), withKnots(angular, {0.2, 0.5, 0.5})});
  const auto raised = refined(inserted, {elevated(withKnots(radial, {0.3, 0.6}), 3),
                                         elevated(withKnots(angular, {0.2, 0.5, 0.5}), 2)});
  EXPECT_EQ(raised.basis().direction(0).degree(), 4);
  EXPECT_LT(distance(ring, inserted), 1e-13);
  EXPECT_LT(distance(ring, raised), 1e-13);

  const auto shell = sphereSegment({0.0, 0.0, 0.0}, 0.5, 1.0, {0.0, 1.0}, {0.0, 1.0});
  EXPECT_LT(distance(shell, refined(shell, {KnotVector::uniform(2, 3), KnotVector::uniform(3, 4),
                                            KnotVector::uniform(4, 5)})),
            1e-13);
}

TEST(Refinement, KeepsTheContinuityOfEveryBreakpoint) {
  const KnotVector knots(2, {0, 0, 0, 0.5, 1, 1, 1});
  EXPECT_EQ(elevated(knots, 1), KnotVector(3, {0, 0, 0, 0, 0.5, 0.5, 1, 1, 1, 1}));
}

TEST(Refinement, RefusesSpacesThatDoNotContainTheCoarseOne) {
  const KnotVector coarse(2, {0, 0, 0, 0.5, 1, 1, 1});
  EXPECT_THROW(refinementMatrix(coarse, KnotVector::uniform(1, 2)), Error);
  EXPECT_THROW(refinementMatrix(coarse, KnotVector(2, {0, 0, 0, 0.4, 1, 1, 1})), Error);
  EXPECT_THROW(refinementMatrix(coarse, KnotVector(3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1})), Error);
}

TEST(Patch, UniformRectangleHasItsControlPointsAtTheGrevilleAbscissae) {
  const auto slab =
      refined(rectangle({0.0, 0.0}, {3.0, 1.0}), {KnotVector::uniform(3, 46), KnotVector::uniform(3, 22)});
  ASSERT_EQ(slab.basis().numFunctions(), 49 * 25);
  const auto& x = slab.basis().direction(0);
  for (int i = 0; i < 49; ++i) {
    EXPECT_NEAR(slab.points()(0, i), 3.0 * x.anchor(i), 1e-14);
    EXPECT_NEAR(slab.points()(1, i), 0.0, 1e-14);
  }
}

TEST(Patch, RationalDerivativesAgreeWithDifferences) {
  const auto ring = refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 2.0),
                            {KnotVector::uniform(2, 3), KnotVector::uniform(3, 4)});
  const double h = 1e-6;
  std::mt19937 generator(4);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Vector2d xi = 0.01 + 0.98 * randomParameter<2>(generator).array();
    for (int d = 0; d < 2; ++d) {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(d);
      const Eigen::Vector2d difference = (ring.position(xi + step) - ring.position(xi - step)) / (2.0 * h);
      EXPECT_LT((difference - ring.jacobian(xi).col(d)).norm(), 1e-8);
    }
  }
}

TEST(Patch, TraceIsThePatchOnItsFace) {
  const auto ring = refined(annulus({0.0, 0.0}, 1.0, 2.0, 0.0, 2.0),
                            {KnotVector::uniform(2, 3), KnotVector::uniform(3, 4)});
  for (const double s : {0.0, 0.31, 0.9, 1.0}) {
    const Eigen::Vector<double, 1> t(s);
    EXPECT_LT((tracePatch(ring, faceFromName<2>("left")).position(t) - ring.position({0.0, s})).norm(),
              1e-14);
    EXPECT_LT((tracePatch(ring, faceFromName<2>("right")).position(t) - ring.position({1.0, s})).norm(),
              1e-14);
    EXPECT_LT((tracePatch(ring, faceFromName<2>("bottom")).position(t) - ring.position({s, 0.0})).norm(),
              1e-14);
    EXPECT_LT((tracePatch(ring, faceFromName<2>("top")).position(t) - ring.position({s, 1.0})).norm(), 1e-14);
  }
  const auto cube = refined(box({0, 0, 0}, {1, 2, 3}), {KnotVector::uniform(1, 2), KnotVector::uniform(2, 3),
                                                        KnotVector::uniform(3, 2)});
  EXPECT_LT((tracePatch(cube, faceFromName<3>("front")).position({0.2, 0.7}) - Eigen::Vector3d(0.2, 1.4, 3.0))
                .norm(),
            1e-14);
  EXPECT_LT((tracePatch(cube, faceFromName<3>("left")).position({0.2, 0.7}) - Eigen::Vector3d(0.0, 0.4, 2.1))
                .norm(),
            1e-14);
  EXPECT_THROW(faceFromName<2>("front"), Error);
}

TEST(Patch, LagrangeInterpolantPassesThroughTheGeometryAtItsNodes) {
  const auto ring = annulus({0.0, 0.0}, 1.0, 2.0, 0.0, kPi / 2);
  double previous = 0.0;
  for (const int spans : {2, 4, 8}) {
    const auto interpolant =
        lagrangeInterpolant(ring, 2, {{0.0, 1.0}, KnotVector::uniform(1, spans).breakpoints()});
    for (int a = 0; a < interpolant.basis().numFunctions(); ++a) {
      const double radius = interpolant.points().col(a).norm();
      EXPECT_LT(std::min({std::abs(radius - 1.0), std::abs(radius - 1.5), std::abs(radius - 2.0)}), 1e-14);
    }
    const double error = distance(ring, interpolant);
    if (previous > 0.0) {
      EXPECT_GT(std::log2(previous / error), 2.7) << "cubic convergence of the geometry";
    }
    previous = error;
  }
}

TEST(Patch, RefusesWeightsAndSizesThatDoNotFit) {
  const TensorBasis<1> line({UnivariateBasis::bspline(KnotVector::uniform(1, 1))});
  EXPECT_THROW((Patch<1, 2>(line, Eigen::MatrixXd::Zero(2, 3), Eigen::VectorXd::Ones(3))), Error);
  EXPECT_THROW((Patch<1, 2>(line, Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1.0, -1.0))), Error);
  EXPECT_THROW((Patch<1, 2>(line, Eigen::MatrixXd::Zero(2, 2), Eigen::VectorXd::Ones(3))), Error);
}

}  // namespace
}  // namespace burnish
