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

using test::kBottom;
using test::kFront;
using test::kRight;
using test::kTop;

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

/// Differences of a place's neighbours against its tangents and curvatures.
template <int Dim>
void expectDerivatives(const MasterSurface<Dim>& surface, const SurfacePlace<Dim>& place, double tolerance) {
  const auto point = surface.at(place);
  EXPECT_NEAR(point.shape.R.sum(), 1.0, 1e-14);
  EXPECT_LT(point.shape.dR.colwise().sum().norm(), 1e-12);
  const double step = 1e-6;
  for (int d = 0; d < Dim - 1; ++d) {
    SurfacePlace<Dim> before = place, after = place;
    before.xi(d) -= step;
    after.xi(d) += step;
    const auto low = surface.at(before), high = surface.at(after);
    EXPECT_LT(((high.x - low.x) / (2.0 * step) - point.tangents.col(d)).norm(), 0.1 * tolerance);
    for (int e = 0; e < Dim - 1; ++e)
      EXPECT_LT(((high.tangents.col(e) - low.tangents.col(e)) / (2.0 * step) -
                 point.curvatures.col(secondDerivative(d, e)))
                    .norm(),
                tolerance);
  }
}

/// Places of a surface around the knot behind spans of its first face, shares of the spans away from it, at which
/// the other parameter is given.
template <int Dim>
std::array<SurfacePlace<Dim>, 2> besideKnot(const MasterSurface<Dim>& surface, int span, double share,
                                            double along = 0.0) {
  const UnivariateBasis& basis = surface.basis(0).direction(0);
  const auto at = [&](int number, double from) {
    const double length = basis.spanEnd(number) - basis.spanBegin(number);
    Eigen::Vector<double, Dim - 1> xi = Eigen::Vector<double, Dim - 1>::Constant(along);
    const int line = Dim == 2 ? 0 : surface.placeOf(0, xi).span / basis.numSpans();
    xi(0) = basis.spanEnd(span) + from * share * length;
    return SurfacePlace<Dim>{0, line * basis.numSpans() + number, xi};
  };
  return {at(span, -1.0), at(span + 1, 1.0)};
}

template <int Dim>
void expectRoundedKnots(const MasterSurface<Dim>& sharp, double along = 0.0) {
  MasterSurface<Dim> surface = sharp;
  surface.roundKinks();
  const int spans = surface.basis(0).direction(0).numSpans();
  for (int span = 0; span < spans - 1; ++span) {
    const auto [before, after] = besideKnot(surface, span, 0.0, along);
    EXPECT_GT((sharp.at(before).normal - sharp.at(after).normal).norm(), 1e-3);
    EXPECT_LT((surface.at(before).normal - surface.at(after).normal).norm(), 1e-13);
    EXPECT_LT((surface.at(before).x - surface.at(after).x).norm(), 1e-15);
    EXPECT_LT((surface.at(before).x - sharp.at(before).x).norm(), 0.01 / spans);
    EXPECT_GT((surface.at(before).x - sharp.at(before).x).norm(), 1e-6);
    // Farther away all is as it was.
    for (const auto& place : besideKnot(surface, span, 0.1, along)) {
      EXPECT_EQ(surface.at(place).x, sharp.at(place).x);
      EXPECT_EQ(surface.at(place).normal, sharp.at(place).normal);
      EXPECT_FALSE(surface.at(place).isRounded[0]);
    }
    for (const auto& place : besideKnot(surface, span, 0.004, along)) {
      EXPECT_TRUE(surface.at(place).isRounded[0]);
      expectDerivatives<Dim>(surface, place, 1e-6);
    }
  }
}

TEST(MasterSurface, RoundsKinksToOneTangent) {
  for (const auto& [family, degree] : {std::pair{BasisFamily::BSpline, 1}, {BasisFamily::Lagrange, 2}}) {
    const Body<2> plane = makeBody(test::wavy<2>(family, degree, 4, 0.1 / degree, 9));
    expectRoundedKnots<2>(MasterSurface<2>(plane, {{0, kTop}}));
    const Body<3> solid = makeBody(test::wavy<3>(family, degree, 3, 0.1 / degree, 9));
    expectRoundedKnots<3>(MasterSurface<3>(solid, {{0, kTop}}), 0.43);
  }
}

TEST(MasterSurface, RoundsCrossingKinksToOneTangentPlane) {
  for (const auto& [family, degree] : {std::pair{BasisFamily::BSpline, 1}, {BasisFamily::Lagrange, 2}}) {
    const Body<3> body = makeBody(test::wavy<3>(family, degree, 3, 0.1 / degree, 9));
    const MasterSurface<3> sharp(body, {{0, kTop}});
    MasterSurface<3> surface = sharp;
    surface.roundKinks();
    const double knot = surface.basis(0).direction(0).spanEnd(1);
    for (const Eigen::Vector2d& xi : {Eigen::Vector2d(knot, knot), Eigen::Vector2d(knot + 0.003, knot),
                                      Eigen::Vector2d(knot, knot - 0.004), Eigen::Vector2d(knot, 1.0)}) {
      const auto first = surface.at(surface.placeOf(0, xi));
      const auto places = surface.around(first.place);
      EXPECT_EQ(places.size(), xi(0) == xi(1) ? 4u : 2u);
      for (const auto& place : places) {
        EXPECT_LT((surface.at(place).x - first.x).norm(), 1e-15);
        EXPECT_LT((surface.at(place).normal - first.normal).norm(), 1e-13);
      }
    }
    for (const double share : {-0.005, 0.004})
      expectDerivatives<3>(surface, surface.placeOf(0, {knot + share, knot + 0.003}), 1e-6);
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

/// The same block with parameters that run the other way along two directions, over longer ranges.
Patch<3> reparametrised(const Patch<3>& patch) {
  const auto& basis = patch.basis();
  std::vector<UnivariateBasis> directions;
  for (const int d : {0, 1, 2}) {
    std::vector<double> knots = basis.direction(d).knots();
    for (double& knot : knots) knot *= d + 1.0;
    directions.push_back(UnivariateBasis::bspline({basis.direction(d).degree(), std::move(knots)}));
  }
  Eigen::MatrixXd points = patch.points();
  for (int a = 0; a < basis.numFunctions(); ++a) {
    auto index = basis.functionIndex(a);
    for (const int d : {0, 2}) {
      auto& number = index[static_cast<std::size_t>(d)];
      number = basis.direction(d).numFunctions() - 1 - number;
    }
    points.col(basis.functionNumber(index)) = patch.points().col(a);
  }
  return {TensorBasis<3>(std::move(directions)), std::move(points), patch.weights()};
}

/// A block of four patches about a vertical line, two of them with other parameters, whose upper faces are bent.
Body<3> bentBlocks() {
  const auto block = [](double x, double z) {
    const Patch<3> patch =
        refined(box({x, -1.0, z}, {1.0, 1.0, 1.0}),
                {KnotVector::uniform(2, 2), KnotVector::uniform(1, 1), KnotVector::uniform(2, 3)});
    Eigen::MatrixXd points = patch.points();
    for (Eigen::Index a = 0; a < points.cols(); ++a) {
      const double u = points(0, a), w = points(2, a);
      points(1, a) -=
          points(1, a) < -0.5 ? 0.0 : 0.2 * std::abs(u) + 0.15 * std::abs(w) + 0.1 * u * std::abs(w);
    }
    return Patch<3>(patch.basis(), points, patch.weights());
  };
  return joinedBody<3>({block(-1.0, -1.0), reparametrised(block(0.0, -1.0)), reparametrised(block(-1.0, 0.0)),
                        block(0.0, 0.0)},
                       {"a", "b", "c", "d"});
}

TEST(MasterSurface, RoundsJointsOfPatchesAndWhereTheyCross) {
  const Body<3> body = bentBlocks();
  const std::vector<FacePlace> faces{{0, kTop}, {1, kTop}, {2, kTop}, {3, kTop}};
  const MasterSurface<3> sharp(body, faces);
  MasterSurface<3> surface = sharp;
  surface.roundKinks();
  for (const Eigen::Vector2d& xi :
       {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(1.0, 0.4), Eigen::Vector2d(0.3, 1.0),
        Eigen::Vector2d(1.0, 0.995), Eigen::Vector2d(0.99, 1.0), Eigen::Vector2d(1.0, 2.0 / 3.0),
        Eigen::Vector2d(1.0, 0.0)}) {
    const auto first = surface.at(surface.placeOf(0, xi));
    const auto places = surface.around(first.place);
    EXPECT_GE(places.size(), 2u);
    double turn = 0.0;
    for (const auto& place : places) {
      turn = std::max(turn, (sharp.at(place).normal - sharp.at(first.place).normal).norm());
      EXPECT_LT((surface.at(place).x - first.x).norm(), 1e-15);
      EXPECT_LT((surface.at(place).normal - first.normal).norm(), 1e-13);
    }
    EXPECT_GT(turn, 0.1);
  }
  for (const Eigen::Vector2d& xi :
       {Eigen::Vector2d(0.996, 0.995), Eigen::Vector2d(0.997, 0.3), Eigen::Vector2d(0.997, -0.02)})
    expectDerivatives<3>(surface, surface.placeOf(0, xi), 1e-6);
}

/// Three faces that meet in one point, with kinks of less than 45 degrees between them: no line goes on there.
TEST(MasterSurface, RoundedKinksEndWithoutAGapWhereThreeFacesMeet) {
  Eigen::MatrixXd points(3, 8);
  const auto around = [](double degrees, double height) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return Eigen::Vector3d(std::cos(angle), std::sin(angle), height);
  };
  // A flattened cube that stands on a corner; the upper one is the last of its control points.
  points << Eigen::Vector3d(0.0, 0.0, -1.0), around(60.0, -0.35), around(300.0, -0.35), around(0.0, -0.2),
      around(180.0, -0.35), around(120.0, -0.2), around(240.0, -0.2), Eigen::Vector3d::Zero();
  const Patch<3> cube = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const Body<3> body =
      makeBody(refined(Patch<3>(cube.basis(), points, cube.weights()),
                       {KnotVector::uniform(1, 2), KnotVector::uniform(1, 2), KnotVector::uniform(1, 2)}));
  const MasterSurface<3> sharp(body, {{0, kRight}, {0, kTop}, {0, kFront}});
  MasterSurface<3> surface = sharp;
  surface.roundKinks();
  bool anyRounded = false;
  for (const double along : {1.0, 0.999, 0.99, 0.9, 0.7, 0.51, 0.5, 0.3})
    for (const Eigen::Vector2d& xi : {Eigen::Vector2d(1.0, along), Eigen::Vector2d(along, 1.0)})
      for (const int face : {0, 1, 2}) {
        const auto first = surface.at(surface.placeOf(face, xi));
        for (const auto& place : surface.around(first.place)) {
          EXPECT_LT((surface.at(place).x - first.x).norm(), 1e-15);
          if (along < 1.0) {
            EXPECT_LT((surface.at(place).normal - first.normal).norm(), 1e-12);
          }
          anyRounded = anyRounded || surface.at(place).isRounded[0];
        }
      }
  EXPECT_TRUE(anyRounded);
  const auto top = surface.at(surface.placeOf(0, {1.0, 1.0}));
  EXPECT_EQ(top.x, sharp.at(top.place).x);
  for (const auto& xi : {Eigen::Vector2d(0.99, 0.7), Eigen::Vector2d(0.999, 0.9)})
    expectDerivatives<3>(surface, surface.placeOf(1, xi), 1e-5);
}

/// A point that goes over a crossing of two kinks, a blunt pyramid or a pit, in small steps, at an angle.
TEST(MasterSurface, FeetGoOverARoundedCrossingSmoothly) {
  for (const double height : {0.2, -0.2}) {
    const Patch<3> block =
        refined(box({-1.0, -1.0, -1.0}, {2.0, 1.0, 2.0}),
                {KnotVector::uniform(1, 2), KnotVector::uniform(1, 1), KnotVector::uniform(1, 2)});
    Eigen::MatrixXd points = block.points();
    for (Eigen::Index a = 0; a < points.cols(); ++a)
      if (points(1, a) > -0.5) points(1, a) = -height * (std::abs(points(0, a)) + std::abs(points(2, a)));
    const Body<3> body = makeBody(Patch<3>(block.basis(), points, block.weights()));
    MasterSurface<3> surface(body, {{0, kTop}});
    surface.roundKinks();
    for (const double above : {1e-3, 0.0, -1e-3}) {
      SurfacePlace<3> place = surface.placeOf(0, {0.48, 0.48});
      Eigen::Vector3d last = Eigen::Vector3d::Zero();
      const int count = 2000;
      for (int k = 0; k <= count; ++k) {
        const double x = -0.05 + 0.1 * k / count, z = 0.6 * x + 0.005;
        const auto foot = surface.project({x, -height * (std::abs(x) + std::abs(z)) + above, z}, place);
        ASSERT_TRUE(foot);
        EXPECT_TRUE(foot->isSmooth());
        if (k > 0) {
          EXPECT_LT((foot->normal - last).norm(), 2e-3);
        }
        last = foot->normal;
        place = foot->point.place;
      }
      EXPECT_EQ(place.span, 3);
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
      EXPECT_FALSE(surface.at(place).isRounded[0]);
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
  for (const Eigen::Vector2d& xi :
       {Eigen::Vector2d(0.41, 0.27), Eigen::Vector2d(1.05, 0.2), Eigen::Vector2d(-0.07, 1.02)})
    expectDerivatives<3>(surface, surface.placeOf(0, xi), 1e-7);
}

template <int Dim>
bool holds(const Eigen::AlignedBox<double, Dim>& box, const Eigen::Vector<double, Dim>& x) {
  return box.exteriorDistance(x) <= 1e-14;
}

TEST(MasterSurface, BoxHoldsTheSpan) {
  for (const BasisFamily family : {BasisFamily::BSpline, BasisFamily::Lagrange}) {
    const Body<3> body = makeBody(test::wavy<3>(family, 2, 3, 0.1, 9));
    const MasterSurface<3> surface(body, {{0, kTop}});
    for (const auto& sample : test::samples(surface, 5))
      EXPECT_TRUE(holds<3>(surface.box(0, sample.place.span), sample.x));
  }
}

TEST(MasterSurface, BoxHoldsRoundedKinks) {
  const Body<2> plane = makeBody(test::wavy<2>(BasisFamily::BSpline, 1, 4, 0.2, 9));
  MasterSurface<2> curve(plane, {{0, kTop}});
  curve.roundKinks();
  for (const int span : {0, 1, 2})
    for (const double share : {0.0, 0.005, 0.02})
      for (const auto& place : besideKnot<2>(curve, span, share))
        EXPECT_TRUE(holds<2>(curve.box(0, place.span), curve.at(place).x));
  for (const auto& [family, degree] : {std::pair{BasisFamily::BSpline, 1}, {BasisFamily::Lagrange, 2}}) {
    const Body<3> solid = makeBody(test::wavy<3>(family, degree, 3, 0.2 / degree, 9));
    MasterSurface<3> surface(solid, {{0, kTop}});
    surface.roundKinks();
    for (const int span : {0, 1})
      for (const double share : {0.0, 0.005, 0.02})
        for (const double along : {0.01, 0.2, 1.0 / 3.0, 0.34, 0.66})
          for (const auto& place : besideKnot<3>(surface, span, share, along))
            EXPECT_TRUE(holds<3>(surface.box(0, place.span), surface.at(place).x));
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
