#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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

/// The roller in a holder: lifted between two passes, with a force that comes and goes.
const std::string kHeldRoller = replaced(
    replaced(kRoller, "moment: 0, schedule: {times: [0, 1], values: [0, 1]}}", "moment: 0}"),
    "path: {course: polyline, points: [[0, 0], [0.5, 0]], speed: 0.5, begin: 1}",
    "path: {course: raster, start: [0, -0.04], stroke: [0.3, 0], feed: [0.1, 0], passes: 2, speed: 0.6, "
    "clearance: [0, 0.05], ramp: 0.06}");

/// Times of its way: down 0.05, along 0.3, up 0.05, back 0.2, down, along, up.
constexpr double kDown = 0.05 / 0.6, kPass = 0.5, kBack = 1.0 / 3.0, kRamp = 0.1;

Scene heldRoller(const Strings& more = {}) {
  Strings overrides{"steps=[{until: 2, count: 60}]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return parseScene(kHeldRoller, "test.yaml", overrides);
}

TEST(ToolOnAPath, MayHaveItsFullForceAtTheMiddleAlone) {
  for (const int passes : {1, 2, 5, 9})
    EXPECT_NO_THROW(heldRoller({"steps=[{until: 20, count: 60}]", "tools[0].path.ramp=0.15",
                                "tools[0].path.passes=" + std::to_string(passes)}))
        << passes;
  EXPECT_THROW(heldRoller({"tools[0].path.ramp=0.1501"}), Error);
}

TEST(ToolOnAPath, ThatCarriesAForceIsLiftedBetweenItsPasses) {
  const Outcome ran = test::run(heldRoller(), "path_held");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  EXPECT_EQ(ran.summary.frames, 6) << "start, two passes, each with the roller on the face and lifted, end";
  const auto& history = ran.history;
  const auto &times = history.column("time"), &height = history.column("roller.uy"),
             &force = history.column("roller.fy");
  int full = 0, inTheAir = 0;
  for (std::size_t k = 1; k < history.numRows(); ++k) {
    const double second = kDown + kPass + kDown + kBack;
    const double sinceDown = times[k] - kDown - (times[k] > second ? second : 0.0);
    const double fromEnds = std::min(sinceDown, kPass - sinceDown);
    const double most = 0.5 * std::lerp(0.05, 1.0, std::clamp(fromEnds / kRamp, 0.0, 1.0));
    EXPECT_LE(force[k], most * (1.0 + 1e-8)) << times[k];
    EXPECT_LT(std::abs(history.column("roller.mz")[k]), 1e-10) << times[k];
    if (fromEnds > 0.0) {
      EXPECT_NEAR(force[k], most, 1e-8 * 0.5) << times[k];
    }
    if (fromEnds > kRamp) ++full;
    if (height[k] <= 0.0) continue;
    ++inTheAir;
    EXPECT_EQ(force[k], 0.0) << times[k];
  }
  EXPECT_GT(full, 15);
  EXPECT_GT(inTheAir, 10);
  EXPECT_NEAR(height.back(), 0.01, 1e-6) << "lifted from where the path was";
}

TEST(ToolOnAPath, ComesDownAndBeginsToRollInFewSteps) {
  const Outcome ran = test::run(heldRoller({"steps=[{until: 2, count: 4}]"}), "path_held_quickly");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  EXPECT_LE(ran.summary.cuts, 10);
  EXPECT_LE(ran.summary.iterations, 150);
}

/// Straight down on a face that rises by an angle, friction rubs at once with all that it has, and the roller has to turn
/// until nothing turns it.
TEST(ToolOnAPath, ThatTurnsFreelyMayComeDownAslant) {
  constexpr double kCarried = 0.5, kRollerRadius = 0.5;
  for (const double degrees : {10.0, 30.0}) {
    const double angle = degrees * std::acos(-1.0) / 180.0, rise = std::tan(angle);
    const Outcome ran =
        test::run(parseScene(fmt::format(R"(
geometry:
  shape: coons
  bottom: {{degrees: [1], points: [[0, 0], [2, 0]]}}
  right: {{degrees: [1], points: [[2, 0], [2, {1}]]}}
  top: {{degrees: [1], points: [[0, 0.5], [2, {1}]]}}
  left: {{degrees: [1], points: [[0, 0], [0, 0.5]]}}
  refine: [40, 8]
material: {{law: neo-hookean, E: 100, nu: 0.3}}
supports: [{{face: bottom, fix: [x, y]}}]
tools:
  - name: roller
    shape: cylinder
    center: [{2}, {3}]
    radius: 0.5
    carry: {{y: -0.5, moment: 0}}
    path: {{course: raster, start: [0, -0.05], stroke: [0.3, {0}], speed: 1, clearance: [0, 0.07], ramp: 0.1}}
contact: [{{tool: roller, face: top, friction: 0.1, method: integral-augmented-lagrangian}}]
steps: [{{until: 1, count: 10}}]
output: {{vtu: false}}
)",
                                         0.3 * rise, 0.5 + 2.0 * rise, 0.8 - kRollerRadius * std::sin(angle),
                                         0.5 + 0.8 * rise + kRollerRadius * std::cos(angle)),
                             "test.yaml"),
                  "path_aslant");
    ASSERT_TRUE(ran.summary.completed) << degrees << ": " << ran.summary.stoppedBecause;
    EXPECT_EQ(ran.summary.cuts, 0) << degrees;
    const auto& history = ran.history;
    int pressed = 0;
    for (std::size_t k = 1; k < history.numRows(); ++k) {
      const double across = history.column("roller.fx")[k], down = history.column("roller.fy")[k];
      EXPECT_LT(std::abs(history.column("roller.mz")[k]), 1e-10 * kCarried * kRollerRadius)
          << degrees << ", row " << k;
      if (down < 0.9 * kCarried) continue;
      ++pressed;
      EXPECT_NEAR(across / down, -rise, 0.05 * rise) << "no friction is left, row " << k;
    }
    EXPECT_GE(pressed, 2);
  }
}

TEST(ToolOnAPath, ThatItsPathKeepsFromItsForceEndsTheRun) {
  const Outcome ran = test::run(heldRoller({"tools[0].path.start=[0, -0.001]"}), "path_shallow");
  EXPECT_FALSE(ran.summary.completed);
  EXPECT_THAT(ran.summary.stoppedBecause, HasSubstr("tool 'roller' does not carry its force in a pass"));
}

TEST(ToolOnAPath, TakesStepsByTheHalfWidthOfItsContact) {
  const Outcome ran = test::run(heldRoller({"tools[0].path.step_per_half_width=0.5", "tools[0].path.passes=1",
                                            "steps=[{until: 1, count: 20}]"}),
                                "path_steps");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  ASSERT_EQ(ran.summary.pathSteps.size(), 1u);
  const auto& steps = ran.summary.pathSteps.front();
  EXPECT_EQ(steps.tool, "roller");
  EXPECT_NEAR(steps.time, kDown + kRamp, 1e-12);
  EXPECT_NEAR(steps.halfWidth, std::sqrt(4.0 * 0.5 * 0.5 * (1.0 - 0.09) / (std::acos(-1.0) * 100.0)),
              0.2 * steps.halfWidth)
      << "Hertz";
  EXPECT_DOUBLE_EQ(steps.longest, 0.5 * steps.halfWidth);
  const auto &times = ran.history.column("time"), &way = ran.history.column("roller.ux");
  int inPass = 0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (times[k - 1] < steps.time - 1e-12 || times[k] > kDown + kPass + 1e-12) continue;
    ++inPass;
    EXPECT_LE(way[k] - way[k - 1], steps.longest * (1.0 + 1e-9)) << times[k];
  }
  EXPECT_GE(inPass, static_cast<int>(0.24 / steps.longest));
}

TEST(ToolOnAPath, IsDoubtedWhereSpansAreLargeAgainstItsContact) {
  const auto isDoubted = [](const Strings& geometry) {
    Strings overrides{"tools[0].path.passes=1", "steps=[{until: 0.8, count: 16}]"};
    overrides.insert(overrides.end(), geometry.begin(), geometry.end());
    const Outcome ran = test::run(heldRoller(overrides), "path_doubt");
    EXPECT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
    return std::ranges::any_of(ran.summary.doubts, [](const DoubtRecord& doubt) {
      return doubt.what.starts_with("fewer than four knot spans over the width of the contact");
    });
  };
  EXPECT_TRUE(isDoubted({})) << "two spans";
  EXPECT_FALSE(
      isDoubted({"geometry={shape: rectangle, size: [2.0, 0.5], resolution: {along: roller, "
                 "half_width: 0.054}}"}));
}

TEST(ToolOnAPath, GoesOnWithTheSameBitsWhenHaltedAfterEveryStep) {
  const Scene scene = heldRoller({"tools[0].path.step_per_half_width=0.9", "tools[0].path.stroke=[0.2, 0]",
                                  "steps=[{until: 1.7, count: 15}]"});
  const test::HaltedHistory found = test::haltedAfterEveryStep(scene, "path");
  EXPECT_GE(found.halts, 15);
  EXPECT_EQ(found.halted, found.whole);
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
  EXPECT_THAT(errorOf({"tools[0].path.points=[[0, 0], [0.5, 0.1]]", "tools[0].path.speed=1"}),
              HasSubstr("tools[0].carry.y: found although the path moves the tool in this way"));
  EXPECT_THAT(errorOf({"tools[0].path.ramp=0.1"}),
              HasSubstr("tools[0].path.ramp: found although the tool carries no force along clearance"));
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
