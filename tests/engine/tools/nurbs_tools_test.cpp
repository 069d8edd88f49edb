#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/tools/box.h"
#include "engine/tools/nurbs_shape.h"
#include "tests/engine/tools/gap_check.h"

namespace burnish {
namespace {

using Eigen::Vector3d;

const std::vector<double> kCircleKnots{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};

/// Control points of a full circle of radius 1 in the plane of the given axes: 3 x 9.
Eigen::Matrix3Xd circlePoints(const Vector3d& a, const Vector3d& b) {
  Eigen::Matrix3Xd points(3, 9);
  points << a, a + b, b, b - a, -a, -a - b, -b, a - b, a;
  return points;
}

Eigen::VectorXd circleWeights() {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(9);
  for (int k = 1; k < 9; k += 2) weights(k) = std::sqrt(0.5);
  return weights;
}

NurbsCurve circle(double radius, const Vector3d& center, bool flip = false) {
  Eigen::Matrix3Xd points = radius * circlePoints(Vector3d::UnitX(), Vector3d::UnitY());
  points.colwise() += center;
  return makeNurbsShape(
      Patch<1, 3>(TensorBasis<1>({UnivariateBasis::bspline({2, kCircleKnots})}), points, circleWeights()),
      flip);
}

/// Half a circle from the south pole to the north pole, turned about z: longitude, latitude.
NurbsSurface sphere(double radius) {
  Eigen::Matrix3Xd points(3, 45);
  Eigen::VectorXd weights(45);
  const std::vector<double> r{0, 1, 1, 1, 0}, z{-1, -1, 0, 1, 1};
  const Eigen::Matrix3Xd ring = circlePoints(Vector3d::UnitX(), Vector3d::UnitY());
  const Eigen::VectorXd ringWeights = circleWeights();
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 9; ++i) {
      const auto k = static_cast<std::size_t>(j);
      points.col(9 * j + i) = radius * (r[k] * ring.col(i) + z[k] * Vector3d::UnitZ());
      weights(9 * j + i) = ringWeights(i) * (j % 2 == 0 ? 1.0 : std::sqrt(0.5));
    }
  return makeNurbsShape(Patch<2, 3>(TensorBasis<2>({UnivariateBasis::bspline({2, kCircleKnots}),
                                                    UnivariateBasis::bspline({2, {0, 0, 0, 1, 1, 2, 2, 2}})}),
                                    points, weights));
}

/// A wavy cubic that is open, running from right to left: the tool is below it.
NurbsCurve wave() {
  Eigen::Matrix3Xd points(3, 6);
  points << 2.0, 1.5, 1.0, 0.5, 0.0, -0.5, 0.0, 0.5, -0.2, 0.4, 0.1, 0.0, 0, 0, 0, 0, 0, 0;
  Eigen::VectorXd weights(6);
  weights << 1.0, 0.8, 1.5, 1.0, 0.7, 1.0;
  return makeNurbsShape(
      Patch<1, 3>(TensorBasis<1>({UnivariateBasis::bspline(KnotVector::uniform(3, 3))}), points, weights));
}

/// A bumpy biquadratic surface over [-1, 1]²; the tool is below it.
NurbsSurface bumps() {
  Eigen::Matrix3Xd points(3, 25);
  Eigen::VectorXd weights(25);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) {
      points.col(5 * j + i) = Vector3d(0.5 * i - 1.0, 0.5 * j - 1.0, 0.15 * std::sin(2.1 * i + 1.3 * j));
      weights(5 * j + i) = 1.0 + 0.3 * std::cos(i + 2.0 * j);
    }
  const auto direction = UnivariateBasis::bspline(KnotVector::uniform(2, 3));
  return makeNurbsShape(Patch<2, 3>(TensorBasis<2>({direction, direction}), points, weights));
}

/// A polygon of degree 1, counterclockwise: the unit square.
NurbsCurve square() {
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0;
  return makeNurbsShape(Patch<1, 3>(TensorBasis<1>({UnivariateBasis::bspline(KnotVector::uniform(1, 4))}),
                                    points, Eigen::VectorXd::Ones(5)));
}

void expectSame(const GapQuery& found, const GapQuery& expected, int dim, double tolerance) {
  EXPECT_NEAR(found.gap, expected.gap, tolerance);
  EXPECT_LT((found.normal - expected.normal).norm(), 10.0 * tolerance);
  const Eigen::Matrix3d difference = found.dNormal - expected.dNormal;
  EXPECT_LT(difference.topLeftCorner(dim, dim).norm(), 1e3 * tolerance);
}

TEST(NurbsCurve, OfACircleIsADisc) {
  const Vector3d center(0.3, -0.2, 0.0);
  const NurbsCurve curve = circle(0.5, center);
  const Cylinder disc{center, Vector3d::UnitZ(), 0.5};
  test::RandomPoints points(center, 1.0, 2);
  for (int k = 0; k < 1'000; ++k) {
    const Vector3d x = points.next();
    if ((x - center).norm() > 0.05) expectSame(curve.query(x), disc.query(x), 2, 1e-11);
  }
  for (const Vector3d& seam :
       {Vector3d(0.81, -0.2, 0.0), Vector3d(0.3, 0.31, 0.0), Vector3d(0.79, -0.2, 0.0)})
    expectSame(curve.query(seam), disc.query(seam), 2, 1e-11);
  expectSame(circle(0.5, center, true).query({0.5, 0.0, 0.0}), -disc.query({0.5, 0.0, 0.0}), 2, 1e-11);
  EXPECT_NEAR(curve.halfThickness(), 0.5, 1e-12);
}

TEST(NurbsCurve, WithCornersIsARectangle) {
  const NurbsCurve curve = square();
  const RoundedBox box{{0.5, 0.5, 0.0}, {1.0, 1.0, std::numeric_limits<double>::infinity()}};
  test::RandomPoints points({0.5, 0.5, 0.0}, 1.0, 2);
  for (int k = 0; k < 1'000; ++k) {
    const Vector3d x = points.next();
    if (const GapQuery expected = box.query(x); expected.gap > -0.3) {
      EXPECT_NEAR(curve.query(x).gap, expected.gap, 1e-12);
      if (expected.gap > 0.0) expectSame(curve.query(x), expected, 2, 1e-11);
    }
  }
}

TEST(NurbsSurface, OfASphereIsASphere) {
  const NurbsSurface surface = sphere(0.5);
  const Sphere ball{Vector3d::Zero(), 0.5};
  test::RandomPoints points(Vector3d::Zero(), 1.0, 3);
  for (int k = 0; k < 1'000; ++k) {
    const Vector3d x = points.next();
    if (x.norm() > 0.1) expectSame(surface.query(x), ball.query(x), 3, 1e-10);
  }
  for (const double depth : {-1e-2, 1e-6, 0.1})
    expectSame(surface.query({0.0, 0.0, 0.5 + depth}), ball.query({0.0, 0.0, 0.5 + depth}), 3, 2e-6);
  EXPECT_NEAR(surface.halfThickness(), 0.5, 1e-12);
}

TEST(NurbsTools, AroundAHollowAreThickWhicheverWayTheyAreGiven) {
  const NurbsCurve disc = circle(0.5, Vector3d::Zero()), die = circle(0.5, Vector3d::Zero(), true);
  EXPECT_NEAR(disc.halfThickness(), 0.5, 1e-12);
  EXPECT_EQ(die.halfThickness(), std::numeric_limits<double>::infinity());
}

/// Curve and surface with rims: their derivatives, and their distance against that to a dense tessellation.
void checkFreeForm(const RigidShape& shape, const SurfaceMesh& dense, const Vector3d& middle, double halfSize,
                   int dim, double low, double pitch) {
  const auto check = test::checkDerivatives(shape, test::RandomPoints(middle, halfSize, dim), dim, low, 1.0);
  EXPECT_EQ(check.points, 2'000);
  EXPECT_LE(check.astray, 4) << "beside changes of curvature at knots and rims";
  test::RandomPoints points(middle, halfSize, dim, 3);
  for (int k = 0; k < 500; ++k) {
    const Vector3d x = points.next();
    const double distance = test::bruteDistance(dense.points, x);
    const double gap = std::abs(shape.query(x).gap);
    EXPECT_LT(gap, distance * (1.0 + 1e-9));
    EXPECT_GT(std::hypot(gap, pitch), distance) << "the points lie apart";
  }
}

TEST(NurbsCurve, OpenAgreesWithDifferencesAndBruteForce) {
  const NurbsCurve curve = wave();
  const SurfaceMesh outline = curve.outline(3, 1.0);
  EXPECT_FALSE(outline.closed);
  checkFreeForm(curve, outline, {0.75, 0.2, 0.0}, 1.4, 2, -0.05, 6e-2);
  EXPECT_LT(curve.query({0.75, -0.5, 0.0}).gap, 0.0) << "the tool is below";
  EXPECT_GT(curve.query({3.0, -0.1, 0.0}).gap, 0.0) << "beyond the rim is outside";
  EXPECT_EQ(curve.halfThickness(), std::numeric_limits<double>::infinity());
}

TEST(NurbsSurface, OpenAgreesWithDifferencesAndBruteForce) {
  const NurbsSurface surface = bumps();
  checkFreeForm(surface, surface.outline(3, 1.0), Vector3d::Zero(), 1.3, 3, -0.05, 6e-2);
  EXPECT_LT(surface.query({0.1, 0.2, -0.5}).gap, 0.0);
}

}  // namespace
}  // namespace burnish
