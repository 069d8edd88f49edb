#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Tools on paths: where they are, what they carry on the way, and how freely they roll.
namespace burnish {
namespace {

using samples::replaced;
using test::Outcome;
using testing::HasSubstr;
using Strings = std::vector<std::string>;

/// An elastic slab that a roller is drawn along, pressed on by a force and free to turn.
const std::string kRoller = R"(
geometry: {shape: rectangle, size: [2.0, 0.5], spans: [40, 8], grading: [s, "1 - (1-s)^1.5"]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - name: roller
    shape: cylinder
    center: [0.6, 1.0]
    radius: 0.5
    carry: {y: -0.5, moment: 0, schedule: {times: [0, 1], values: [0, 1]}}
    path: {course: polyline, points: [[0, 0], [0.5, 0]], speed: 0.5, begin: 1}
contact: [{tool: roller, face: top, friction: 0.5}]
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 4}, {until: 2, count: 20}]
output: {vtu: false}
)";

Outcome ranRoller(const std::string& name, const Strings& overrides = {}) {
  return test::run(parseScene(kRoller, "test.yaml", overrides), "path_" + name);
}

TEST(ToolOnAPath, CarriesItsForceAndRollsWithoutMomentAtEveryStep) {
  const Outcome ran = ranRoller("rolls");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto& history = ran.history;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    const double force = 0.5 * std::min(1.0, history.column("time")[k]);
    EXPECT_NEAR(history.column("roller.fy")[k], force, 1e-8 * 0.5) << k;
    EXPECT_LT(std::abs(history.column("roller.mz")[k]), 1e-10) << k;
    EXPECT_NEAR(history.column("roller.ux")[k], 0.5 * std::max(0.0, history.column("time")[k] - 1.0), 1e-12)
        << k;
  }
}

TEST(ToolOnAPath, RollsWithoutSlipWhereFrictionIsLarge) {
  const Outcome ran = ranRoller("no_slip");
  const auto& angle = ran.history.column("roller.angle");
  const double turned = (angle.back() - angle[4]) * std::acos(-1.0) / 180.0;
  EXPECT_NEAR(turned, -0.5 / 0.5, 0.02) << "the strain of the face makes the rest";
  EXPECT_LT(std::abs(ran.history.column("roller.fx").back()), 0.01 * 0.5)
      << "nothing holds a free roller back";
}

TEST(ToolOnAPath, LeavesAFrameAfterEveryPass) {
  const Outcome ran =
      ranRoller("passes", {"tools[0].path={course: raster, stroke: [0.1, 0], passes: 3, both_ways: true, "
                           "speed: 0.4, begin: 1}",
                           "steps[1].count=4"});
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  EXPECT_EQ(ran.summary.frames, 5) << "start, three passes, end";
}

/// The roller, whose height the path prescribes: pressed in, moved, lifted, taken on and pressed in again.
const std::string kLiftedRoller = replaced(
    replaced(kRoller, "carry: {y: -0.5, moment: 0, schedule: {times: [0, 1], values: [0, 1]}}",
             "carry: {moment: 0}"),
    "path: {course: polyline, points: [[0, 0], [0.5, 0]], speed: 0.5, begin: 1}",
    "path: {course: raster, start: [0, -0.01], stroke: [0.2, 0], feed: [0.1, 0], passes: 2, speed: 0.6, "
    "clearance: [0, 0.05]}");

TEST(ToolOnAPath, ThatOnlyTurnsFreelyIsLiftedAndComesDownAgain) {
  const Outcome ran =
      test::run(parseScene(kLiftedRoller, "test.yaml", {"steps=[{until: 1.5, count: 60}]"}), "path_lifted");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  const auto& history = ran.history;
  const auto &height = history.column("roller.uy"), &force = history.column("roller.fy"),
             &angle = history.column("roller.angle");
  int presses = 0;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    EXPECT_LT(std::abs(history.column("roller.mz")[k]), 1e-10) << k;
    if (height[k] > 0.0 && height[k - 1] > 0.0) {
      EXPECT_EQ(force[k], 0.0) << k;
      EXPECT_NEAR(angle[k], angle[k - 1], 0.05) << "degrees: nothing turns it in the air";
    }
    if (force[k] > 0.0 && force[k - 1] == 0.0) ++presses;
  }
  EXPECT_EQ(presses, 2);
  EXPECT_NEAR(angle.back() * std::acos(-1.0) / 180.0, -2.0 * 0.2 / 0.5, 0.05) << "it rolls in both passes";
}

TEST(ToolOnAPath, WithAForceAcrossItHasToStayOutOfItsWay) {
  const auto errorOf = [](const Strings& overrides) -> std::string {
    try {
      parseScene(kRoller, "test.yaml", overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(errorOf({}), "no error");
  EXPECT_THAT(errorOf({"tools[0].path.clearance=[0, 0.1]", "tools[0].path.speed=5"}),
              HasSubstr("tools[0].carry.y: found although the path moves the tool in this way"));
  EXPECT_THAT(errorOf({"tools[0].path.speed=0.1"}),
              HasSubstr("tools[0].path: found a path that takes until t = 6"));
}

TEST(ToolOnAPath, RefusesAHelixThatGoesNowhere) {
  const auto errorOf = [](const Strings& overrides) -> std::string {
    try {
      parseScene(R"(
geometry: {shape: box, size: [1, 1, 1], spans: [2, 2, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y, z]}]
tools: [{name: ball, shape: sphere, center: [0.5, 0.3, 1.3], radius: 0.2}]
contact: [{tool: ball, face: back}]
steps: [{until: 9, count: 1}]
)",
                 "test.yaml", overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string helix = "tools[0].path={course: helix, center: [0.5, 0.3, 0], speed: 1, ";
  EXPECT_THAT(errorOf({helix + "clearance: [0, 0, 0.1]}"}),
              HasSubstr("tools[0].path: found a helix that goes nowhere"));
  EXPECT_EQ(errorOf({helix + "pitch: 0.1}"}), "no error");
  EXPECT_EQ(errorOf({helix + "turns: 1}", "tools[0].pivot=[0.7, 0.3, 1.3]"}), "no error");
}

}  // namespace
}  // namespace burnish
