#include "engine/tools/tool_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

namespace burnish {
namespace {

using Eigen::Vector3d;
using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kRounding = 1e-14;

auto near(double value) {
  return DoubleNear(value, 1e-12);
}

PathSpec along(PathCourse course) {
  PathSpec spec;
  spec.course = std::move(course);
  return spec;
}

TEST(ToolPath, APolylineIsTakenWithItsSpeed) {
  PathSpec spec = along(PolylinePath{{{0.0, -0.1}, {3.0, -0.1}, {3.0, 0.9}}});
  spec.speed = 2.0;
  spec.begin = 1.0;
  const ToolPath path(spec, Vector3d::Zero());
  EXPECT_THAT(path.corners(), ElementsAre(near(1.0), near(2.5), near(3.0)));
  EXPECT_THAT(path.passEnds(), ElementsAre(near(3.0)));
  EXPECT_LT((path.displacement(0.0) - Vector3d(0.0, -0.1, 0.0)).norm(), kRounding)
      << "it waits where it begins";
  EXPECT_LT((path.displacement(1.75) - Vector3d(1.5, -0.1, 0.0)).norm(), kRounding);
  EXPECT_LT((path.displacement(2.75) - Vector3d(3.0, 0.4, 0.0)).norm(), kRounding);
  EXPECT_LT((path.displacement(9.0) - Vector3d(3.0, 0.9, 0.0)).norm(), kRounding);
}

TEST(ToolPath, ARasterComesDownGoesUpAndFeeds) {
  RasterPath raster;
  raster.start = {0.0, -0.1, 0.0};
  raster.stroke = {4.0, 0.0, 0.0};
  raster.feed = {0.0, 0.0, 3.0};
  raster.passes = 2;
  PathSpec spec = along(raster);
  spec.clearance = {0.0, 1.0, 0.0};
  const ToolPath path(spec, Vector3d::Zero());
  // down 1, pass 4, up 1, back 5 (4 and 3), down 1, pass 4, up 1
  EXPECT_THAT(path.corners(),
              ElementsAre(0.0, near(1), near(5), near(6), near(11), near(12), near(16), near(17)));
  EXPECT_THAT(path.passEnds(), ElementsAre(near(5), near(16)));
  EXPECT_LT((path.displacement(0.0) - Vector3d(0.0, 0.9, 0.0)).norm(), kRounding);
  EXPECT_LT((path.displacement(3.0) - Vector3d(2.0, -0.1, 0.0)).norm(), kRounding);
  EXPECT_LT((path.displacement(14.0) - Vector3d(2.0, -0.1, 3.0)).norm(), kRounding);

  for (const double t : {0.0, 0.5, 3.0, 4.999, 11.0, 11.5, 15.0}) EXPECT_FALSE(path.isLifted(t)) << t;
  for (const double t : {5.001, 6.0, 10.0, 10.999, 16.001, 20.0}) EXPECT_TRUE(path.isLifted(t)) << t;
  for (const double t : {0.0, 3.0, 8.0, 14.0})
    EXPECT_LT((path.wayAhead(t) - Vector3d(4.0, 0.0, 0.0)).norm(), kRounding) << t;
  EXPECT_TRUE(path.wayAhead(16.5).isZero(0.0));
}

TEST(ToolPath, WithoutClearanceIsNeverLifted) {
  PathSpec spec = along(PolylinePath{{{0.0, -0.1}, {3.0, -0.1}, {1.0, -0.1}}});
  const ToolPath path(spec, Vector3d::Zero());
  for (const double t : {0.0, 2.0, 4.0, 9.0}) EXPECT_FALSE(path.isLifted(t)) << t;
  EXPECT_LT((path.wayAhead(4.0) - Vector3d(-2.0, 0.0, 0.0)).norm(), kRounding);
}

TEST(ToolPath, ARampTakesTheForceUpAndDownInEveryPass) {
  RasterPath raster;
  raster.stroke = {4.0, 0.0, 0.0};
  raster.feed = {0.0, 0.0, 3.0};
  raster.passes = 2;
  PathSpec spec = along(raster);
  spec.speed = 2.0;
  spec.clearance = {0.0, 1.0, 0.0};
  spec.ramp = 1.0;
  const ToolPath path(spec, Vector3d::Zero());  // the first pass from 0.5 to 2.5
  for (const double t : {0.0, 0.3, 0.5, 2.5, 2.6}) EXPECT_DOUBLE_EQ(path.forceShare(t), 0.05) << t;
  for (const double t : {0.75, 2.25}) EXPECT_DOUBLE_EQ(path.forceShare(t), 0.525) << t;
  for (const double t : {1.0, 1.7, 2.0}) {
    EXPECT_DOUBLE_EQ(path.forceShare(t), 1.0) << t;
    EXPECT_TRUE(path.hasFullForce(t)) << t;
  }
  for (const double t : {0.99, 2.01, 3.0}) EXPECT_FALSE(path.hasFullForce(t)) << t;
  EXPECT_THAT(path.corners(), testing::IsSupersetOf({near(1.0), near(2.0), near(6.5), near(7.5)}));
}

TEST(ToolPath, ARampTakesTheForceUpAndDownOnceInAllTurnsOfAHelix) {
  HelixPath helix;
  helix.turns = 2.5;
  PathSpec spec = along(helix);
  spec.clearance = {1.0, 0.0, 0.0};
  spec.ramp = 2.0;
  const ToolPath path(spec, Vector3d(2.0, 0.0, 0.0));
  const double begin = 1.0, perTurn = 4.0 * std::numbers::pi, end = begin + 2.5 * perTurn;
  EXPECT_EQ(path.passes().size(), 3u) << "a frame for every turn";
  ASSERT_EQ(path.touches().size(), 1u);
  EXPECT_NEAR(path.touches().front().begin, begin, kRounding);
  EXPECT_NEAR(path.touches().front().end, end, 1e-12);
  for (const double t : {begin + 1.0, end - 1.0}) EXPECT_NEAR(path.forceShare(t), 0.525, 1e-12) << t;
  for (const double t : {begin + 2.0, begin + perTurn, begin + 2.0 * perTurn, end - 2.0}) {
    EXPECT_NEAR(path.forceShare(t), 1.0, 1e-12) << t;
    EXPECT_TRUE(path.hasFullForce(t)) << t;
  }
  EXPECT_FALSE(path.hasFullForce(end - 1.9));
  EXPECT_LT((path.clearance(begin + 0.25 * perTurn) - Vector3d(0.0, 1.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((path.displacement(path.end()) - Vector3d(-5.0, 0.0, 0.0)).norm(), 1e-12) << "lifted where it is";
}

TEST(ToolPath, ARasterMayGoToAndFro) {
  RasterPath raster;
  raster.stroke = {4.0, 0.0, 0.0};
  raster.feed = {0.0, 0.0, 1.0};
  raster.passes = 3;
  raster.bothWays = true;
  const ToolPath path(along(raster), Vector3d::Zero());
  EXPECT_THAT(path.passEnds(), ElementsAre(near(4), near(9), near(14)));
  EXPECT_LT((path.displacement(6.0) - Vector3d(3.0, 0.0, 1.0)).norm(), kRounding);
  EXPECT_LT((path.displacement(14.0) - Vector3d(4.0, 0.0, 2.0)).norm(), kRounding);
}

TEST(ToolPath, AHelixKeepsItsDistanceAndItsSpeed) {
  HelixPath helix;
  helix.center = {1.0, 0.0, 0.0};
  helix.axis = Vector3d(0.0, 0.0, 2.0);
  helix.pitch = 0.5;
  helix.turns = 1.25;
  PathSpec spec = along(helix);
  spec.speed = 0.7;
  const Vector3d pivot(3.0, 0.0, 1.0);
  const ToolPath path(spec, pivot);
  const double perTurn = std::hypot(2.0 * std::numbers::pi * 2.0, 0.5) / 0.7;
  EXPECT_THAT(path.passEnds(), ElementsAre(near(perTurn), near(1.25 * perTurn)));
  EXPECT_LT((path.displacement(perTurn) - Vector3d(0.0, 0.0, 0.5)).norm(), 1e-12);
  EXPECT_LT((path.displacement(0.25 * perTurn) - Vector3d(-2.0, 2.0, 0.125)).norm(), 1e-12);
  EXPECT_NEAR(path.turn(0.25 * perTurn), 0.5 * std::numbers::pi, 1e-12);
  for (double t = 0.0; t < path.end(); t += 0.37) {
    const Vector3d arm = pivot + path.displacement(t) - Vector3d(helix.center);
    EXPECT_NEAR(arm.head<2>().norm(), 2.0, 1e-12);
    const double step = 1e-5 * (t > 0.0 ? 1.0 : 0.0);
    if (step > 0.0) {
      EXPECT_NEAR((path.displacement(t + step) - path.displacement(t - step)).norm() / (2.0 * step), 0.7,
                  1e-7);
    }
  }
}

}  // namespace
}  // namespace burnish
