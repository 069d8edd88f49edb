#include "engine/contact/master_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "engine/core/error.h"
#include "engine/nurbs/refinement.h"
#include "engine/nurbs/shapes.h"
#include "engine/solid/joined_body.h"
#include "tests/engine/contact/surface_samples.h"

namespace burnish {
namespace {

constexpr FaceId kRight = 1, kBottom = 2, kTop = 3, kFront = 5;

template <int Dim>
Eigen::Vector<double, Dim> randomPoint(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> uniform(low, high);
  Eigen::Vector<double, Dim> point;
  for (double& coordinate : point) coordinate = uniform(random);
  return point;
}

/// Largest component of x - y along the tangents of the parameters that move, relative to the coordinates.
template <int Dim>
double residual(const Foot<Dim>& foot, const Eigen::Vector<double, Dim>& x) {
  double largest = 0.0;
  for (int d = 0; d < Dim - 1; ++d)
    if (foot.moves[static_cast<std::size_t>(d)])
      largest = std::max(largest, std::abs((x - foot.point.x).dot(foot.point.tangents.col(d).normalized())));
  return largest / (x.norm() + foot.point.x.norm());
}

TEST(MasterSurface, FindsThePointOfTwoArcsThatJoinSmoothly) {
  // Two faces of a quarter disc, between which the map is not invertible, each of several spans.
  const Patch<2> sector = discSector({1.0, 2.0}, 3.0, 0.0, 1.5);
  const Body<2> body = makeBody(refined(sector, {KnotVector::uniform(2, 3), KnotVector::uniform(3, 4)}));
  const MasterSurface<2> surface(body, {{0, kRight}, {0, kTop}});
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const double angle = std::uniform_real_distribution<double>(0.01, 1.49)(random);
    const double gap = std::uniform_real_distribution<double>(-1.5, 2.0)(random);
    const Eigen::Vector2d way(std::cos(angle), std::sin(angle)),
        x = Eigen::Vector2d(1.0, 2.0) + (3.0 + gap) * way;
    // From a place anywhere on both arcs.
    const auto start = test::samples(surface, 3)[static_cast<std::size_t>(k % 21)];
    const auto foot = surface.project(x, start.place);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->gap, gap, 1e-13);
    EXPECT_LT((foot->normal - way).norm(), 1e-13);
    EXPECT_TRUE(foot->isSmooth());
    EXPECT_NEAR(foot->shareOfRadius(), -gap / 3.0, 1e-12);
    EXPECT_LT(residual<2>(*foot, x), 1e-14);
  }
}

TEST(MasterSurface, StopsAtAConvexCornerAndKeepsOneSideOfAConcaveOne) {
  const Body<2> block = makeBody(
      refined(rectangle({0.0, 0.0}, {2.0, 1.0}), {KnotVector::uniform(2, 3), KnotVector::uniform(2, 2)}));
  const MasterSurface<2> surface(block, {{0, kTop}, {0, kRight}});
  const Eigen::Vector2d x(2.3, 1.4);
  for (const int face : {0, 1}) {
    const auto foot = surface.project(x, surface.placeOf(face, Eigen::Vector<double, 1>(0.3)));
    ASSERT_TRUE(foot);
    EXPECT_FALSE(foot->moves[0]);
    EXPECT_NEAR(foot->gap, 0.5, 1e-15);
    EXPECT_LT((foot->normal - Eigen::Vector2d(0.6, 0.8)).norm(), 1e-14);
  }
  // In the corner itself the normal is the mean of both.
  const auto touching = surface.project({2.0, 1.0}, surface.placeOf(0, Eigen::Vector<double, 1>(0.9)));
  ASSERT_TRUE(touching);
  EXPECT_EQ(touching->gap, 0.0);
  // Inside, both sides have a closest point.
  const Eigen::Vector2d inside(1.9, 0.8);
  const auto below = surface.project(inside, surface.placeOf(0, Eigen::Vector<double, 1>(0.8)));
  const auto beside = surface.project(inside, surface.placeOf(1, Eigen::Vector<double, 1>(0.6)));
  ASSERT_TRUE(below && beside);
  EXPECT_NEAR(below->gap, -0.2, 1e-14);
  EXPECT_NEAR(beside->gap, -0.1, 1e-14);
}

TEST(MasterSurface, SeesAConcaveKinkFromInside) {
  // A body above a roof: its lower face is a concave kink, which points inside have as their closest point.
  Patch<2> sheet =
      refined(rectangle({-1.0, 0.0}, {2.0, 3.0}), {KnotVector::uniform(1, 2), KnotVector::uniform(1, 1)});
  Eigen::MatrixXd points = sheet.points();
  points(1, 1) = 1.0;
  const Body<2> body = makeBody(Patch<2>(sheet.basis(), points, sheet.weights()));
  const MasterSurface<2> surface(body, {{0, kBottom}});
  const Eigen::Vector2d x(0.1, 1.5);
  const auto foot = surface.project(x, surface.placeOf(0, Eigen::Vector<double, 1>(0.2)));
  ASSERT_TRUE(foot);
  EXPECT_FALSE(foot->moves[0]);
  EXPECT_NEAR(foot->gap, -std::hypot(0.1, 0.5), 1e-14);
  EXPECT_LT((foot->normal - (x - Eigen::Vector2d(0.0, 1.0)) / foot->gap).norm(), 1e-14);
}

/// Places of a plane surface around the knot between two spans of its first face, shares of the spans away from it.
std::array<SurfacePlace<2>, 2> besideKnot(const MasterSurface<2>& surface, int span, double share) {
  const UnivariateBasis& basis = surface.basis(0).direction(0);
  const auto at = [&](int number, double from) {
    const double length = basis.spanEnd(number) - basis.spanBegin(number);
    return SurfacePlace<2>{0, number, Eigen::Vector<double, 1>(basis.spanEnd(span) + from * share * length)};
  };
  return {at(span, -1.0), at(span + 1, 1.0)};
}

TEST(MasterSurface, RoundsKinksToOneTangent) {
  for (const auto& [family, degree] : {std::pair{BasisFamily::BSpline, 1}, {BasisFamily::Lagrange, 2}}) {
    const Body<2> body = makeBody(test::wavy<2>(family, degree, 4, 0.1 / degree, 9));
    const MasterSurface<2> sharp(body, {{0, kTop}});
    MasterSurface<2> surface = sharp;
    surface.roundKinks();
    for (const int span : {0, 1, 2}) {
      const auto [before, after] = besideKnot(surface, span, 0.0);
      EXPECT_GT((sharp.at(before).normal - sharp.at(after).normal).norm(), 1e-3);
      EXPECT_LT((surface.at(before).normal - surface.at(after).normal).norm(), 1e-13);
      EXPECT_LT((surface.at(before).x - surface.at(after).x).norm(), 1e-15);
      EXPECT_LT((surface.at(before).x - sharp.at(before).x).norm(), 0.01 * 0.25);
      // Farther away all is as it was.
      for (const auto& place : besideKnot(surface, span, 0.1)) {
        EXPECT_EQ(surface.at(place).x, sharp.at(place).x);
        EXPECT_EQ(surface.at(place).normal, sharp.at(place).normal);
        EXPECT_FALSE(surface.at(place).isRounded);
      }
      for (const auto& place : besideKnot(surface, span, 0.004)) {
        const auto point = surface.at(place);
        EXPECT_TRUE(point.isRounded);
        EXPECT_NEAR(point.shape.R.sum(), 1.0, 1e-14);
        EXPECT_NEAR(point.shape.dR.sum(), 0.0, 1e-12);
        const double step = 1e-6;
        SurfacePlace<2> low = place, high = place;
        low.xi(0) -= step;
        high.xi(0) += step;
        const auto tangents = (surface.at(high).x - surface.at(low).x) / (2.0 * step);
        const auto curvatures = (surface.at(high).tangents - surface.at(low).tangents) / (2.0 * step);
        EXPECT_LT((tangents - point.tangents).norm(), 1e-8);
        EXPECT_LT((curvatures - point.curvatures).norm(), 1e-6);
      }
    }
  }
}

/// A point that goes over a kink in small steps: its normal turns without a jump, on either side of the surface.
TEST(MasterSurface, FeetGoOverARoundedKinkSmoothly) {
  for (const double height : {0.3, -0.3}) {
    Patch<2> sheet =
        refined(rectangle({-1.0, -1.0}, {2.0, 1.0}), {KnotVector::uniform(1, 2), KnotVector::uniform(1, 1)});
    Eigen::MatrixXd points = sheet.points();
    points(1, 4) = height;
    const Body<2> body = makeBody(Patch<2>(sheet.basis(), points, sheet.weights()));
    MasterSurface<2> surface(body, {{0, kTop}});
    surface.roundKinks();
    for (const double above : {1e-3, 0.0, -1e-3}) {
      SurfacePlace<2> place = surface.placeOf(0, Eigen::Vector<double, 1>(0.45));
      Eigen::Vector2d last = surface.at(place).normal;
      const int count = 2000;
      for (int k = 0; k <= count; ++k) {
        const double x = -0.05 + 0.1 * k / count;
        const auto foot = surface.project({x, height * (1.0 - std::abs(x)) + above}, place);
        ASSERT_TRUE(foot);
        EXPECT_TRUE(foot->isSmooth());
        EXPECT_LT((foot->normal - last).norm(), 2e-3);
        last = foot->normal;
        place = foot->point.place;
      }
      EXPECT_EQ(place.span, 1);
    }
  }
}

TEST(MasterSurface, LeavesCornersSharpAndWhatIsSmoothAsItIs) {
  const Body<2> block = makeBody(
      refined(rectangle({0.0, 0.0}, {2.0, 1.0}), {KnotVector::uniform(2, 3), KnotVector::uniform(1, 2)}));
  MasterSurface<2> surface(block, {{0, kTop}, {0, kRight}});
  surface.roundKinks();
  EXPECT_FALSE(surface.project({2.3, 1.4}, surface.placeOf(0, Eigen::Vector<double, 1>(0.9)))->moves[0]);
  for (const auto& sample : test::samples(surface, 2))
    for (const auto& place :
         surface.around({sample.place.face, sample.place.span,
                         Eigen::Vector<double, 1>(
                             surface.basis(sample.place.face).direction(0).spanEnd(sample.place.span))}))
      EXPECT_FALSE(surface.at(place).isRounded);
}

TEST(MasterSurface, GoesOnStraightBeyondAFreeEnd) {
  const Patch<2> sector = discSector({0.0, 0.0}, 2.0, 0.0, 1.5);
  const Body<2> body = makeBody(refined(sector, {KnotVector::uniform(2, 2), KnotVector::uniform(2, 4)}));
  const MasterSurface<2> surface(body, {{0, kRight}});
  // Below the arc's begin, where its tangent is vertical.
  const Eigen::Vector2d x(2.5, -0.05);
  const auto foot = surface.project(x, surface.placeOf(0, Eigen::Vector<double, 1>(0.5)));
  ASSERT_TRUE(foot);
  EXPECT_NEAR(foot->gap, 0.5, 1e-14);
  EXPECT_NEAR(foot->point.x(1), -0.05, 1e-14);
  EXPECT_TRUE(foot->isSmooth());
  const double overhang = surface.overhang(foot->point.place);
  EXPECT_GT(overhang, 0.1);
  EXPECT_LT(overhang, 0.5);
  EXPECT_LT(surface.overhang(surface.placeOf(0, Eigen::Vector<double, 1>(0.1))), 0.0);
  EXPECT_FALSE(surface.project({2.5, -1.5}, surface.placeOf(0, Eigen::Vector<double, 1>(0.5))));
}

TEST(MasterSurface, AgreesWithTheDistanceToABoxAtFacesEdgesAndCorners) {
  const Patch<3> cube = box({0.0, 0.0, 0.0}, {2.0, 1.0, 1.5});
  const Body<3> body = makeBody(
      refined(cube, {KnotVector::uniform(2, 3), KnotVector::uniform(2, 2), KnotVector::uniform(1, 2)}));
  const MasterSurface<3> surface(body, {{0, kTop}, {0, kFront}, {0, kRight}});
  const Eigen::Vector3d corner(2.0, 1.0, 1.5);
  std::mt19937 random(2);
  const auto starts = test::samples(surface, 2);
  int smooth = 0, lines = 0, corners = 0;
  for (int k = 0; k < 400; ++k) {
    Eigen::Vector3d x = corner + randomPoint<3>(random, -0.7, 0.7);
    const Eigen::Vector3d way = (x - corner).cwiseMax(0.0);
    if (way.norm() < 0.01) continue;  // inside
    const auto foot = surface.project(x, starts[static_cast<std::size_t>(k) % starts.size()].place);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->gap, way.norm(), 1e-13);
    EXPECT_LT((foot->normal - way.normalized()).norm(), 1e-12);
    EXPECT_LT(residual<3>(*foot, x), 1e-14);
    const auto outside = (way.array() > 0.0).count();
    const auto moving = foot->moves[0] + foot->moves[1];
    EXPECT_EQ(moving, 3 - outside);
    ++(moving == 2 ? smooth : moving == 1 ? lines : corners);
  }
  EXPECT_GT(smooth, 50);
  EXPECT_GT(lines, 50);
  EXPECT_GT(corners, 20);
}

TEST(MasterSurface, CrossesGluedPatchesOfASphere) {
  // Two shells that share a face; their spheres are one surface across the meridian between them.
  const double quarter = 0.25 * std::numbers::pi;
  const std::vector<KnotVector> knots{KnotVector::uniform(1, 1), KnotVector::uniform(2, 2),
                                      KnotVector::uniform(3, 2)};
  const auto shell = [&](double begin, double end) {
    return refined(sphereSegment({0.0, 0.0, 0.0}, 1.0, 2.0, {begin, end}, {-0.6, 0.7}), knots);
  };
  const Body<3> body = joinedBody<3>({shell(0.0, quarter), shell(quarter, 2.0 * quarter)}, {"west", "east"});
  const MasterSurface<3> outer(body, {{0, kRight}, {1, kRight}}), inner(body, {{1, 0}, {0, 0}});
  std::mt19937 random(3);
  for (int k = 0; k < 200; ++k) {
    const double longitude = std::uniform_real_distribution<double>(0.02, 1.55)(random);
    const double latitude = std::uniform_real_distribution<double>(-0.55, 0.65)(random);
    const double gap = std::uniform_real_distribution<double>(-0.5, 0.45)(random);
    const Eigen::Vector3d way(std::cos(latitude) * std::cos(longitude),
                              std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    const int face = k % 2;
    const auto foot = outer.project((2.0 + gap) * way, outer.placeOf(face, {0.5, 0.5}));
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->gap, gap, 1e-13);
    EXPECT_TRUE(foot->isSmooth());
    EXPECT_NEAR(foot->shareOfRadius(), -gap / 2.0, 1e-11);
    const auto below = inner.project((1.0 - gap) * way, inner.placeOf(face, {0.5, 0.5}));
    ASSERT_TRUE(below);
    EXPECT_NEAR(below->gap, gap, 1e-13);
    EXPECT_LT((below->normal + way).norm(), 1e-12);
  }
}

/// The number of feet on lines and at corners.
template <int Dim>
int expectNearestAmongSamples(const MasterSurface<Dim>& surface, double spread, unsigned seed) {
  const auto fine = test::samples(surface, Dim == 2 ? 200 : 25), coarse = test::samples(surface, 4);
  std::mt19937 random(seed);
  int held = 0, wrong = 0;
  for (int k = 0; k < 60; ++k) {
    const auto& base = fine[std::uniform_int_distribution<std::size_t>(0, fine.size() - 1)(random)];
    const Eigen::Vector<double, Dim> x = base.x + randomPoint<Dim>(random, -spread, spread);
    const auto nearest = test::nearest(fine, x);
    const auto foot = surface.project(x, test::nearest(coarse, x).place);
    if (!foot || surface.overhang(foot->point.place) > 0.0) continue;
    EXPECT_LT(residual<Dim>(*foot, x), 1e-14);
    const double distance = (x - foot->point.x).norm();
    EXPECT_NEAR(std::abs(foot->gap), distance, 1e-12);
    // Never farther than the nearest sample, but for points with several closest places.
    if (!(distance <= (x - nearest.x).norm() + 1e-12)) ++wrong;
    if (!foot->isSmooth()) ++held;
  }
  EXPECT_LE(wrong, 2);
  return held;
}

class WavySurface : public testing::TestWithParam<BasisFamily> {};

TEST_P(WavySurface, NoSampleIsNearerThanTheFoot) {
  int held = 0;
  for (const int degree : {1, 2, 3}) {
    const Body<2> plane = makeBody(test::wavy<2>(GetParam(), degree, 6, 0.12, 5));
    held += expectNearestAmongSamples<2>(MasterSurface<2>(plane, {{0, kTop}, {0, kRight}}), 0.12, 6);
    const Body<3> solid = makeBody(test::wavy<3>(GetParam(), degree, 3, 0.12, 7));
    held +=
        expectNearestAmongSamples<3>(MasterSurface<3>(solid, {{0, kTop}, {0, kRight}, {0, kFront}}), 0.12, 8);
  }
  EXPECT_GT(held, GetParam() == BasisFamily::Lagrange ? 25 : 5);
}

INSTANTIATE_TEST_SUITE_P(Families, WavySurface, testing::Values(BasisFamily::BSpline, BasisFamily::Lagrange));

TEST(MasterSurface, FollowsTheBody) {
  const Body<3> body = makeBody(test::wavy<3>(BasisFamily::BSpline, 2, 3, 0.1, 9));
  MasterSurface<3> surface(body, {{0, kTop}});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3 * body.numNodes);
  for (int node = 0; node < body.numNodes; ++node) x.segment<3>(3 * node) = Eigen::Vector3d(0.1, 0.2, 0.3);
  const auto before = surface.at(surface.placeOf(0, {0.3, 0.6}));
  surface.moveTo(x);
  const auto after = surface.at(surface.placeOf(0, {0.3, 0.6}));
  EXPECT_LT((after.x - before.x - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-15);
}

TEST(MasterSurface, DerivativesAgreeWithDifferencesAlsoBeyondTheEnds) {
  const Body<3> body = makeBody(test::wavy<3>(BasisFamily::BSpline, 3, 3, 0.1, 9));
  const MasterSurface<3> surface(body, {{0, kTop}});
  const double step = 1e-6;
  for (const Eigen::Vector2d& xi :
       {Eigen::Vector2d(0.41, 0.27), Eigen::Vector2d(1.05, 0.2), Eigen::Vector2d(-0.07, 1.02)}) {
    const SurfacePlace<3> place = surface.placeOf(0, xi);
    const auto point = surface.at(place);
    for (int d = 0; d < 2; ++d) {
      SurfacePlace<3> before = place, after = place;
      before.xi(d) -= step;
      after.xi(d) += step;
      const auto low = surface.at(before), high = surface.at(after);
      EXPECT_LT(((high.x - low.x) / (2.0 * step) - point.tangents.col(d)).norm(), 1e-8);
      for (int e = 0; e < 2; ++e)
        EXPECT_LT(((high.tangents.col(e) - low.tangents.col(e)) / (2.0 * step) -
                   point.curvatures.col(secondDerivative(d, e)))
                      .norm(),
                  1e-7);
    }
  }
}

TEST(MasterSurface, HullHoldsTheSpan) {
  for (const BasisFamily family : {BasisFamily::BSpline, BasisFamily::Lagrange}) {
    const Body<3> body = makeBody(test::wavy<3>(family, 2, 3, 0.1, 9));
    const MasterSurface<3> surface(body, {{0, kTop}});
    for (const auto& sample : test::samples(surface, 5)) {
      const auto hull = surface.hull(0, sample.place.span);
      ASSERT_EQ(hull.cols(), 9);
      const Eigen::Vector3d low = hull.rowwise().minCoeff(), high = hull.rowwise().maxCoeff();
      EXPECT_TRUE((sample.x.array() >= low.array() - 1e-14).all() &&
                  (sample.x.array() <= high.array() + 1e-14).all());
    }
  }
}

TEST(MasterSurface, HullHoldsRoundedKinks) {
  const Body<2> body = makeBody(test::wavy<2>(BasisFamily::BSpline, 1, 4, 0.2, 9));
  MasterSurface<2> surface(body, {{0, kTop}});
  surface.roundKinks();
  for (const int span : {0, 1, 2})
    for (const double share : {0.0, 0.005, 0.02})
      for (const auto& place : besideKnot(surface, span, share)) {
        const auto hull = surface.hull(0, place.span);
        const Eigen::Vector2d x = surface.at(place).x;
        EXPECT_TRUE((x.array() >= hull.rowwise().minCoeff().array() - 1e-15).all() &&
                    (x.array() <= hull.rowwise().maxCoeff().array() + 1e-15).all());
      }
}

TEST(MasterSurface, RefusesAFaceThatIsNamedTwice) {
  const Body<2> block = makeBody(rectangle({0.0, 0.0}, {2.0, 1.0}));
  EXPECT_THAT(
      [&] {
        MasterSurface<2>(block, {{0, kTop}, {0, kTop}});
      },
      testing::ThrowsMessage<Error>(testing::HasSubstr("face top of patch 1 is named twice")));
}

}  // namespace
}  // namespace burnish
