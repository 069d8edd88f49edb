#include "engine/tools/tool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/tools/sphere.h"
#include "engine/tools/tool_load.h"
#include "tests/engine/solid/term_check.h"

namespace burnish {
namespace {

using Eigen::Vector3d;

TEST(TurnByVector, IsARotationWithItsDerivative) {
  const Vector3d axis = Vector3d(0.3, -0.5, 0.8).normalized(), r(0.7, 0.2, -0.4);
  for (const double angle : {0.0, 1e-9, 0.9e-4, 1.1e-4, 1e-2, 0.5, 3.0}) {
    const Vector3d theta = angle * axis;
    const TurnByVector turn = turned(theta);
    EXPECT_LT((turn.rotation - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 1e-14) << angle;
    constexpr double kStep = 1e-5;
    for (int d = 0; d < 3; ++d) {
      const Vector3d step = kStep * Vector3d::Unit(d);
      const Vector3d change =
          (turned(theta + step).rotation - turned(theta - step).rotation) * r / (2.0 * kStep);
      EXPECT_LT((change - turn.byVector.col(d).cross(turn.rotation * r)).norm(), 1e-9) << angle;
    }
  }
}

/// A ball that is pressed down with the force 2 in a holder of stiffness 10, whose place is 0.5 t.
struct HeldBall {
  Tool tool;
  ToolLoad load;

  HeldBall() : tool(made()), load(tool, {{{}, {}, [](double) { return -2.0; }, {}}}, 1.0) {
    load.setHolder(
        {.dof = 2, .sign = -1.0, .mustCarry = [](double t) { return t > 0.5; }, .stiffness = 10.0});
  }

  static Tool made() {
    Tool held{"ball", Sphere{}};
    held.unknowns[2] = 0;
    held.motion[2] = [](double t) { return 0.5 * t; };
    return held;
  }

  /// Its force on the body, upwards.
  double forceAt(double t, double z) { return -test::forceOf(load, t, Eigen::VectorXd::Constant(1, z))(0); }
};

TEST(ToolInAHolder, IsPressedOnWithTheSmallerOfForceAndResistance) {
  HeldBall ball;
  EXPECT_DOUBLE_EQ(ball.forceAt(0.2, 0.1), 0.0) << "in the air it is where its path takes it";
  EXPECT_DOUBLE_EQ(ball.forceAt(0.2, 0.15), -0.5);
  EXPECT_FALSE(ball.load.carriesTooLittle()) << "it need not carry all yet";
  EXPECT_DOUBLE_EQ(ball.forceAt(0.2, 0.31), -2.0);
  EXPECT_DOUBLE_EQ(ball.forceAt(0.2, 0.9), -2.0);
  EXPECT_DOUBLE_EQ(ball.forceAt(0.2, 0.05), 0.5) << "it is held back";
  static_cast<void>(ball.forceAt(1.0, 0.9));
  EXPECT_FALSE(ball.load.carriesTooLittle());
  static_cast<void>(ball.forceAt(1.0, 0.6));
  EXPECT_TRUE(ball.load.carriesTooLittle());
}

TEST(ToolThatFollowsASurface, GoesAlongItsNormalFromWhereItsMotionHasIt) {
  Tool tool{"ball", Sphere{}};
  tool.motion[0] = [](double t) { return 2.0 * t; };
  tool.motion[1] = [](double) { return -1.0; };
  tool.normal = [](double t) { return Vector3d(std::sin(t), 0.0, std::cos(t)); };
  tool.unknowns[kNormal] = 1;
  const ToolPose pose = tool.pose(0.5, Eigen::Vector2d(7.0, 0.3));
  EXPECT_LT((pose.displacement - Vector3d(1.0 + 0.3 * std::sin(0.5), -1.0, 0.3 * std::cos(0.5))).norm(),
            1e-15);
  EXPECT_EQ(tool.pose(0.5).displacement, Vector3d(1.0, -1.0, 0.0));
  const ToolLoad load(tool, {{[](double t) { return -4.0 * t; }, {}, {}, {}}}, 1.0);
  EXPECT_LT((load.force(0.5) + 2.0 * Vector3d(std::sin(0.5), 0.0, std::cos(0.5))).norm(), 1e-15);
}

TEST(ToolThatFollowsASurface, IsPushedBackIntoItsHolderAlongTheNormal) {
  Tool tool{"ball", Sphere{}};
  tool.motion[2] = [](double t) { return -0.5 * t; };
  tool.normal = [](double) { return Vector3d(0.0, 0.6, 0.8); };
  tool.unknowns[kNormal] = 0;
  ToolLoad load(tool, {{[](double) { return -2.0; }, {}, {}, {}}}, 1.0);
  load.setHolder(
      {.dof = kNormal, .sign = -1.0, .mustCarry = [](double t) { return t > 0.5; }, .stiffness = 10.0});
  const auto forceAt = [&](double t, double way) {
    return test::forceOf(load, t, Eigen::VectorXd::Constant(1, way))(0);
  };
  EXPECT_DOUBLE_EQ(forceAt(0.2, 0.0), 0.0) << "in the air it is where its path takes it";
  EXPECT_DOUBLE_EQ(forceAt(0.2, 0.15), 1.5);
  EXPECT_DOUBLE_EQ(forceAt(0.2, 0.3), 2.0);
  EXPECT_FALSE(load.carriesTooLittle());
  static_cast<void>(forceAt(1.0, 0.1));
  EXPECT_TRUE(load.carriesTooLittle());
}

TEST(ToolInAHolder, TangentAgreesWithCentralDifferences) {
  HeldBall ball;
  for (const double z : {0.05, 0.15})
    EXPECT_LT(test::tangentError(ball.load, 0.2, Eigen::VectorXd::Constant(1, z), 1e-6), 1e-8) << z;
}

}  // namespace
}  // namespace burnish
