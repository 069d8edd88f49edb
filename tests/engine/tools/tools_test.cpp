#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "engine/tools/tool_shape.h"
#include "tests/engine/tools/gap_check.h"

namespace burnish {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;
constexpr double kHalfAngle = 0.6;  // radians
constexpr double kHalfDegrees = kHalfAngle * 180.0 / kPi, kDegrees = 2.0 * kHalfDegrees;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Matrix3d turn() {
  return Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
}

struct Sample {
  std::string name;
  RigidShape shape;
  int dim;
  Vector3d middle;
  double halfSize;
};

std::vector<Sample> samples() {
  const Vector3d up = Vector3d::UnitY();
  const RoundedBox box{{0.1, 0.2, -0.1}, {1.0, 0.8, 1.2}, 0.15, turn()};
  RoundedBox rectangle{{0.1, 0.2, 0.0}, {1.0, 0.8, kInfinity}, 0.15, Eigen::Matrix3d::Identity()};
  rectangle.axes.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.3).toRotationMatrix();
  return {
      {"plane", Plane{{0.1, 0.2, 0.0}, {0.3, 2.0, 1.0}}, 3, {0, 0, 0}, 1.0},
      {"cylinder", Cylinder{{0.1, 0.2, 0.3}, {1.0, 0.2, -0.4}, 0.5}, 3, {0, 0, 0}, 1.0},
      {"disc", Cylinder{{0.1, 0.2, 0.0}, Vector3d::UnitZ(), 0.5}, 2, {0, 0, 0}, 1.0},
      {"sphere", Sphere{{0.1, 0.2, 0.3}, 0.5}, 3, {0, 0, 0}, 1.0},
      {"edge", Edge{{0.1, 0.2, 0.3}, {0.2, -1.0, 0.1}, {1.0, 0.3, 0.0}, kDegrees, 0.1}, 3, {0, 0, 0}, 1.0},
      {"wedge", Edge{{0.1, 0.2, 0.0}, -up, Vector3d::UnitZ(), kDegrees, 0.1}, 2, {0, 0, 0}, 1.0},
      {"sharp wedge", Edge{{0.1, 0.2, 0.0}, -up, Vector3d::UnitZ(), kDegrees, 0.0}, 2, {0, 0, 0}, 1.0},
      {"cone", Cone{{0.1, 0.2, 0.3}, {0.2, -1.0, 0.1}, kHalfDegrees, 0.1}, 3, {0, 0, 0}, 1.0},
      {"torus", Torus{{0.1, 0.2, 0.3}, {0.2, -1.0, 0.1}, 0.8, 0.3}, 3, {0, 0, 0}, 1.5},
      {"box", box, 3, {0, 0, 0}, 1.2},
      {"rectangle", rectangle, 2, {0, 0, 0}, 1.0},
      {"die", Die{box}, 3, {0, 0, 0}, 1.2},
      {"union",
       Union{{Sphere{{-0.3, 0.0, 0.0}, 0.4}, Cylinder{{0.3, 0.0, 0.0}, Vector3d::UnitZ(), 0.5}}},
       3,
       {0, 0, 0},
       1.0},
      {"blend",
       Union{{Sphere{{-0.3, 0.0, 0.0}, 0.4}, Die{Sphere{{0.0, 0.3, 0.0}, 1.2}},
              Plane{{0.0, -0.3, 0.0}, {0.1, 1.0, 0.2}}},
             0.3},
       3,
       {0, 0, 0},
       0.8}};
}

class EveryShape : public testing::TestWithParam<std::size_t> {
 protected:
  const Sample sample_ = samples()[GetParam()];
};

TEST_P(EveryShape, DerivativesAgreeWithDifferences) {
  const auto& [name, shape, dim, middle, halfSize] = sample_;
  const auto check =
      test::checkDerivatives(shape, test::RandomPoints(middle, halfSize, dim), dim, -0.08, 1.0);
  EXPECT_EQ(check.points, 2'000) << name;
  EXPECT_LE(check.astray, 2) << name;
  EXPECT_GT(check.points, 100 * check.astray);
}

TEST_P(EveryShape, GapIsTheDistanceToTheSurface) {
  const auto& [name, shape, dim, middle, halfSize] = sample_;
  if (name == "blend") GTEST_SKIP() << "no distance by intention";
  test::RandomPoints points(middle, halfSize, dim, 2);
  for (int k = 0; k < 2'000; ++k) {
    const Vector3d x = points.next();
    const GapQuery found = shape.query(x);
    EXPECT_NEAR(found.normal.norm(), 1.0, 1e-12) << name;
    if (found.gap < -0.08 || name == "union") continue;
    const Vector3d foot = x - found.gap * found.normal;
    EXPECT_NEAR(shape.query(foot).gap, 0.0, 1e-9) << name << ": the foot is on the surface";
  }
}

/// Normal of a cell away from the tool, its length twice the area or the length.
Vector3d cellNormal(const SurfaceMesh& mesh, Eigen::Index cell) {
  const auto at = [&](Eigen::Index k) -> Vector3d { return mesh.points.col(mesh.cells(k, cell)); };
  if (mesh.cells.rows() == 2) return (at(1) - at(0)).cross(Vector3d::UnitZ());
  return (at(1) - at(0)).cross(at(2) - at(0));
}

TEST_P(EveryShape, OutlineLiesOnTheSurfaceAndLooksOutwards) {
  const auto& [name, shape, dim, middle, halfSize] = sample_;
  const SurfaceMesh outline = shape.outline(dim, 2.0);
  ASSERT_GT(outline.cells.cols(), 0) << name;
  ASSERT_EQ(outline.cells.rows(), dim) << name;
  for (Eigen::Index k = 0; k < outline.points.cols(); ++k)
    EXPECT_NEAR(shape.query(outline.points.col(k)).gap, 0.0, 1e-5) << name;
  Eigen::Index turnedOver = 0;
  for (Eigen::Index c = 0; c < outline.cells.cols(); ++c) {
    Vector3d center = Vector3d::Zero();
    for (int k = 0; k < dim; ++k) center += outline.points.col(outline.cells(k, c)) / dim;
    const GapQuery query = shape.query(center);
    EXPECT_NEAR(query.gap, 0.0, 3e-3) << name << ": 5 degrees look round";
    if (query.normal.dot(cellNormal(outline, c)) < -1e-12) ++turnedOver;
  }
  EXPECT_LE(turnedOver, name == "blend" ? outline.cells.cols() / 100 : 0) << name << ": small folds at seams";
}

TEST(Outline, OfABlendEndsWhereItsNormalsCancel) {
  const Vector3d z = Vector3d::UnitZ();
  const Union joined{{Cylinder{{-0.3, 0.0, 0.0}, z, 0.3}, Cylinder{{0.3, 0.0, 0.0}, z, 0.3}}, 0.2};
  const SurfaceMesh outline = joined.outline(2, 3.0);
  ASSERT_TRUE(outline.points.allFinite());
  for (Eigen::Index c = 0; c < outline.cells.cols(); ++c)
    for (Eigen::Index k = 0; k < 2; ++k)
      EXPECT_NEAR(joined.query(outline.points.col(outline.cells(k, c))).gap, 0.0, 0.01);
}

TEST(Outline, IsCutWhereTheShapeIsInfinite) {
  const SurfaceMesh plane = Plane{{1.0, 2.0, 0.0}, Vector3d::UnitY()}.outline(2, 3.0);
  EXPECT_NEAR(plane.points.row(0).maxCoeff(), 4.0, 1e-12);
  EXPECT_NEAR(plane.points.row(0).minCoeff(), -2.0, 1e-12);
  EXPECT_FALSE(plane.closed);
  EXPECT_TRUE(Sphere{}.outline(3, 3.0).closed);
  EXPECT_TRUE(RoundedBox{}.outline(3, 3.0).closed);
  EXPECT_NEAR(RoundedBox{}.outline(3, 3.0).points.maxCoeff(), 0.5, 1e-12) << "also without rounding";
}

INSTANTIATE_TEST_SUITE_P(All, EveryShape, testing::Range<std::size_t>(0, samples().size()),
                         [](const auto& parameter) {
                           std::string name = samples()[parameter.param].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

/// Points on the rounded edge of half angle β from its definition: an arc and two flanks.
Eigen::Matrix3Xd wedgePoints(const Edge& edge, double length, int count) {
  const Vector3d center = edge.tip - edge.radius * edge.direction;
  const Vector3d across = edge.direction.cross(Vector3d::UnitZ());
  Eigen::Matrix3Xd points(3, 3 * count);
  const double limit = kPi / 2 - kHalfAngle;
  for (int k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) / (count - 1);
    const double angle = limit * (2.0 * s - 1.0);
    points.col(k) = center + edge.radius * (std::cos(angle) * edge.direction + std::sin(angle) * across);
    for (const double side : {-1.0, 1.0}) {
      const Vector3d normal = std::cos(limit) * edge.direction + side * std::sin(limit) * across;
      const Vector3d down = -std::sin(limit) * edge.direction + side * std::cos(limit) * across;
      points.col((side < 0 ? 1 : 2) * count + k) = center + edge.radius * normal + s * length * down;
    }
  }
  return points;
}

TEST(Edge, GapAgreesWithBruteForce) {
  const Edge edge{{0.1, 0.2, 0.0}, -Vector3d::UnitY(), Vector3d::UnitZ(), kDegrees, 0.1};
  const Eigen::Matrix3Xd surface = wedgePoints(edge, 4.0, 20'000);
  test::RandomPoints points({0.1, 0.2, 0.0}, 0.8, 2);
  for (int k = 0; k < 300; ++k) {
    const Vector3d x = points.next();
    EXPECT_NEAR(std::abs(edge.query(x).gap), test::bruteDistance(surface, x), 2e-4);
  }
  EXPECT_LT(edge.query({0.1, 0.5, 0.0}).gap, 0.0) << "the wedge is behind its tip";
}

TEST(Cone, IsTheEdgeTurnedAboutItsAxis) {
  const Cone cone{{0.0, 0.2, 0.0}, -Vector3d::UnitY(), kHalfDegrees, 0.1};
  const Edge edge{{0.0, 0.2, 0.0}, -Vector3d::UnitY(), Vector3d::UnitZ(), kDegrees, 0.1};
  test::RandomPoints points(Vector3d::Zero(), 1.0, 2);
  for (int k = 0; k < 1'000; ++k) {
    const Vector3d x = points.next();
    const GapQuery turned = cone.query(x), plane = edge.query(x);
    EXPECT_NEAR(turned.gap, plane.gap, 1e-12);
    EXPECT_LT((turned.normal - plane.normal).norm(), 1e-12);
    const Eigen::Matrix3d difference = turned.dNormal - plane.dNormal;
    EXPECT_LT(difference.topLeftCorner(2, 2).norm(), 1e-9);
  }
}

TEST(Cone, OnItsAxisCurvesAsItsTipDoes) {
  const Cone cone{Vector3d::Zero(), -Vector3d::UnitZ(), kHalfDegrees, 0.1};
  const GapQuery answer = cone.query({0.0, 0.0, -0.05});
  EXPECT_DOUBLE_EQ(answer.gap, 0.05);
  Eigen::Matrix3d expected = Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_LT((answer.dNormal - expected / 0.15).norm(), 1e-9);
}

TEST(RoundedBox, GapInsideIsThatOfTheNearestFace) {
  const RoundedBox box{Vector3d::Zero(), {2.0, 1.0, 1.5}, 0.1, Eigen::Matrix3d::Identity()};
  EXPECT_DOUBLE_EQ(box.query({0.0, 0.3, 0.0}).gap, -0.2);
  EXPECT_DOUBLE_EQ(box.query({-0.9, 0.1, 0.0}).gap, -0.1);
  EXPECT_NEAR(box.query({2.0, 1.5, 1.75}).gap, Vector3d(1.1, 1.1, 1.1).norm() - 0.1, 1e-14) << "at a corner";
}

TEST(Die, TurnsTheSolidInsideOut) {
  const Sphere ball{{0.1, 0.2, 0.3}, 0.5};
  const RigidShape die = Die{ball};
  const Vector3d x(0.2, 0.1, 0.3);
  EXPECT_EQ(die.query(x).gap, -ball.query(x).gap);
  EXPECT_GT(die.query(x).gap, 0.0) << "the body is in the hollow";
  EXPECT_EQ(die.query(x).normal, -ball.query(x).normal);
  EXPECT_EQ(die.query(x).dNormal, -ball.query(x).dNormal);
}

TEST(Union, IsExactAwayFromTheSeamAndLowerAlongIt) {
  const Plane floor{Vector3d::Zero(), Vector3d::UnitY()}, wall{Vector3d::Zero(), Vector3d::UnitX()};
  const RigidShape sharp = Union{{floor, wall}}, blended = Union{{floor, wall}, 0.3};
  EXPECT_EQ(sharp.query({0.2, 0.1, 0.0}).gap, 0.1);
  EXPECT_EQ(blended.query({0.5, 0.1, 0.0}).gap, 0.1);
  EXPECT_NEAR(blended.query({0.1, 0.1, 0.0}).gap, 0.1 - 0.3 / 6.0, 1e-15);
  EXPECT_LT(blended.query({0.1, 0.1, 0.0}).normal.norm(), 0.8) << "a mean of two normals";
}

TEST(Shape, IsRecordedAsItIsOrAsItIsDrawn) {
  const RigidShape ball = Sphere{{0.1, 0.2, 0.3}, 0.5}, die = Die{ball};
  const RecordedShape kept = ball.recorded(3, 2.0), drawn = die.recorded(3, 2.0);
  EXPECT_EQ(std::get<Sphere>(kept).radius, 0.5);
  EXPECT_EQ(std::get<SurfaceMesh>(drawn).points, die.outline(3, 2.0).points);
}

TEST(Shape, HasANameOfItsOwn) {
  std::set<std::string> names;
  const auto kinds = kindsOf(ToolShape());
  for (const ShapeKind& kind : kinds) names.insert(kind.key);
  EXPECT_EQ(names.size(), kinds.size());
}

TEST(HalfThickness, IsTheDepthToTheMiddle) {
  const Sphere ball{Vector3d::Zero(), 0.5};
  EXPECT_EQ((Plane{}.halfThickness()), kInfinity);
  EXPECT_EQ(ball.halfThickness(), 0.5);
  EXPECT_EQ((Cylinder{Vector3d::Zero(), Vector3d::UnitZ(), 0.4}.halfThickness()), 0.4);
  EXPECT_EQ((RoundedBox{Vector3d::Zero(), {2.0, 1.0, 1.5}, 0.1, Eigen::Matrix3d::Identity()}.halfThickness()),
            0.5);
  EXPECT_EQ((Torus{Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.3}.halfThickness()), 0.3);
  EXPECT_EQ((Die{ball}.halfThickness()), kInfinity);
  EXPECT_EQ((Die{Torus{Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.3}}.halfThickness()), 0.7);
  EXPECT_EQ((Union{{Plane{}, ball}}.halfThickness()), 0.5);
}

}  // namespace
}  // namespace burnish
