#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/analysis/build_model.h"
#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Balls that roll in space: pressed on by a force or a depth, moved along a path, free to spin.
namespace burnish {
namespace {

using samples::replaced;
using test::Outcome;
using testing::HasSubstr;
using Strings = std::vector<std::string>;

constexpr double kForce = 0.5, kRadius = 0.5, kDegree = std::numbers::pi / 180.0;

/// An elastic block that a ball is drawn along, a little off the middle, so that it also spins about the normal.
const std::string kBall = R"(
geometry: {shape: box, size: [1.0, 0.8, 0.4], spans: [10, 8, 4]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports: [{face: back, fix: [x, y, z]}]
tools:
  - name: ball
    shape: sphere
    center: [0.3, 0.3, 0.9]
    radius: 0.5
    carry: {z: -0.5, spin: true, schedule: {times: [0, 1], values: [0, 1]}}
    path: {course: polyline, points: [[0, 0, 0], [0.3, 0, 0], [0.4, 0.1, 0]], speed: 0.4, begin: 1}
contact: [{tool: ball, face: front, friction: 0.5}]
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 2}, {until: 2.5, count: 12}]
output: {vtu: false}
)";

Outcome ran(const std::string& name, const Strings& overrides = {}) {
  return test::run(parseScene(kBall, "test.yaml", overrides), "ball_" + name);
}

TEST(SpinningBall, CarriesItsForceAndNoMomentAtEveryStep) {
  const Outcome rolled = ran("moment");
  ASSERT_TRUE(rolled.summary.completed) << rolled.summary.stoppedBecause;
  const auto& history = rolled.history;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    const double force = kForce * std::min(1.0, history.column("time")[k]);
    EXPECT_NEAR(history.column("ball.fz")[k], force, 1e-8 * kForce) << k;
    for (const char* moment : {"ball.mx", "ball.my", "ball.mz"})
      EXPECT_LT(std::abs(history.column(moment)[k]), 1e-10 * kForce * kRadius) << moment << " in row " << k;
  }
  EXPECT_GT(std::abs(history.column("ball.angle_z").back()), 1e-3) << "it spins about the normal too";
}

TEST(SpinningBall, RollsWithoutSlipWhereFrictionIsLarge) {
  const Outcome rolled =
      ran("rolls", {"tools[0].path.points=[[0, 0, 0], [0.4, 0, 0]]", "tools[0].center=[0.3, 0.4, 0.9]"});
  ASSERT_TRUE(rolled.summary.completed) << rolled.summary.stoppedBecause;
  const auto& history = rolled.history;
  EXPECT_NEAR(history.column("ball.angle_y").back() * kDegree * kRadius, 0.4, 0.02 * 0.4)
      << "the strain of the face makes the rest";
  EXPECT_NEAR(history.column("ball.angle_x").back(), 0.0, 1e-6) << "symmetry";
  EXPECT_NEAR(history.column("ball.angle_z").back(), 0.0, 1e-6) << "symmetry";
  const Outcome roller = ran(
      "roller", {"tools[0].path.points=[[0, 0, 0], [0.4, 0, 0]]", "tools[0].center=[0.3, 0.4, 0.9]",
                 "tools[0].pivot_axis=[0, 1, 0]", "tools[0].carry.spin=false", "tools[0].carry.moment=0"});
  ASSERT_TRUE(roller.summary.completed) << roller.summary.stoppedBecause;
  EXPECT_NEAR(roller.history.column("ball.angle").back(), history.column("ball.angle_y").back(), 1e-6)
      << "about its axis a roller turns alike";
}

TEST(SpinningBall, ThatIsPressedByItsDepthIsLiftedAndComesDownAgain) {
  const Outcome rolled =
      ran("lifted",
          {"geometry.spans=[6, 5, 3]", "tools[0].carry={spin: true}",
           "tools[0].path={course: raster, start: [0, 0, -0.02], stroke: [0.2, 0, 0], feed: [0.1, 0.1, 0], "
           "passes: 2, speed: 1, clearance: [0, 0, 0.05]}",
           "steps=[{until: 1, count: 40}]"});
  ASSERT_TRUE(rolled.summary.completed) << rolled.summary.stoppedBecause;
  const auto& history = rolled.history;
  const auto &height = history.column("ball.uz"), &angle = history.column("ball.angle_y");
  int inTheAir = 0;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    if (height[k] <= 0.0 || height[k - 1] <= 0.0) continue;
    ++inTheAir;
    EXPECT_EQ(history.column("ball.fz")[k], 0.0) << k;
    EXPECT_NEAR(angle[k], angle[k - 1], 0.05) << "degrees: nothing turns it in the air";
  }
  EXPECT_GT(inTheAir, 3);
  EXPECT_NEAR(angle.back() * kDegree * kRadius, 2.0 * 0.2, 0.02) << "it rolls in both passes";
}

/// An elastic block on which a ball lies with all of its force at once, which moves a little: x0 is where it lies.
Outcome pressedAtOnce(const std::string& name, double x0, const std::string& method) {
  return test::run(
      parseScene(
          "{geometry: {shape: box, origin: [-0.5, -0.5, -1], size: [1, 1, 1], spans: [7, 6, 6]}, "
          "material: {law: neo-hookean, E: 1, nu: 0.3}, supports: [{face: back, fix: [x, y, z]}], "
          "tools: [{name: ball, shape: sphere, center: [0, 0, 0.5], radius: 0.5, carry: {z: -0.006, spin: true}, "
          "prescribe: {x: 0}}], contact: [{tool: ball, face: front, friction: 0.3}], "
          "solver: {linear: multigrid, tolerance: 1.0e-11}, steps: [{until: 1, count: 1}], output: {vtu: false}}",
          "test.yaml",
          {fmt::format("tools[0].center=[{}, 0, 0.5]", x0), "tools[0].prescribe.x=1e-7*t",
           "contact[0].method=" + method}),
      "ball_at_once_" + name);
}

TEST(SpinningBall, MayCarryAllOfItsForceFromTheStart) {
  for (const char* method : {"augmented-lagrangian", "integral-augmented-lagrangian", "penalty"})
    for (const double x0 : {0.0, 0.02, 1.0 / 14.0}) {
      const Outcome pressed = pressedAtOnce(fmt::format("{}_{}", method, x0), x0, method);
      ASSERT_TRUE(pressed.summary.completed) << method << x0 << pressed.summary.stoppedBecause;
      EXPECT_EQ(pressed.summary.cuts, 0) << method << " at " << x0;
      EXPECT_LE(pressed.summary.iterations, 12) << method << " at " << x0;
      EXPECT_NEAR(pressed.history.column("ball.fz").back(), 0.006, 1e-8 * 0.006);
    }
}

TEST(SpinningBall, GoesOnWithTheSameBitsWhenHaltedAfterEveryStep) {
  const Scene scene = parseScene(kBall, "test.yaml",
                                 {"steps=[{until: 1, count: 1}, {until: 2, count: 3}]",
                                  "tools[0].path.points=[[0, 0, 0], [0.1, 0.05, 0]]"});
  const test::HaltedHistory found = test::haltedAfterEveryStep(scene, "ball");
  EXPECT_GE(found.halts, 3);
  EXPECT_EQ(found.halted, found.whole);
  EXPECT_THAT(found.whole, HasSubstr("ball.angle_y"));
}

std::string errorOf(const Strings& overrides) {
  try {
    static_cast<void>(buildModel<3>(parseScene(kBall, "test.yaml", overrides)));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SpinningBall, HasToBeABallThatSomethingTurns) {
  EXPECT_EQ(errorOf({}), "no error");
  EXPECT_THAT(errorOf({"tools[0].pivot=[0.3, 0.3, 1.0]"}),
              HasSubstr("tools[0].carry.spin: tool 'ball' is no ball about its pivot"));
  EXPECT_THAT(errorOf({"tools[0].shape=cylinder", "tools[0].axis=[0, 1, 0]"}),
              HasSubstr("tools[0].carry.spin: tool 'ball' is no ball about its pivot"));
  EXPECT_THAT(errorOf({"contact=[{tool: ball, face: front}]"}),
              HasSubstr("tools[0].carry.spin: nothing turns tool 'ball', as no contact of it has friction"));
  EXPECT_THAT(errorOf({"tools[0].carry.moment=0"}),
              HasSubstr("tools[0].carry.spin: found true beside moment; allowed: one of the two."));
}

}  // namespace
}  // namespace burnish
