#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/analysis/build_model.h"
#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Tools that are taken away: what they pressed and rubbed with fades, in balance, and a body is left without load.
namespace burnish {
namespace {

using samples::replaced;
using test::Outcome;
using testing::HasSubstr;
using testing::Not;
using Strings = std::vector<std::string>;

/// A block on a floor under a disc that is pressed in and drawn aside.
const std::string kPressedBlock = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], spans: [12, 5]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{name: floor, face: bottom, fix: [x, y]}]
tools:
  - name: disc
    shape: cylinder
    center: [0.9, 1.6]
    radius: 0.6
    motion: {times: [0, 0.5, 1], x: [0, 0, 0.1], y: [0, -0.08, -0.08]}
    until: 1
    released_by: 2
contact: [{tool: disc, face: top, friction: 0.3}]
measures: [{name: middle, kind: point, parameters: [0.5, 1], fields: [displacement, stress]}]
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 12}, {until: 2.5, count: 6}]
output: {vtu: false, reactions: true}
)";

Outcome ranPressed(const std::string& name, const Strings& overrides = {},
                   const std::string& yaml = kPressedBlock) {
  Outcome ran = test::run(parseScene(yaml, "test.yaml", overrides), "leaving_" + name);
  EXPECT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  return ran;
}

/// Value of a column at a time.
double valueAt(const Outcome& ran, const std::string& column, double time) {
  const auto& times = ran.history.column("time");
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - time) < 1e-9) return ran.history.column(column)[k];
  throw Error("no such time");
}

TEST(LeavingTool, WhatItPressedAndRubbedWithFadesLinearly) {
  const Outcome ran = ranPressed("fade");
  for (const char* force : {"fx", "fy"}) {
    const std::string floor = std::string("floor.") + force, disc = std::string("disc.") + force;
    EXPECT_GT(std::abs(valueAt(ran, floor, 1.0)), 0.005);
    EXPECT_NEAR(valueAt(ran, floor, 1.0) + valueAt(ran, disc, 1.0), 0.0, 1e-10);
    for (const double t : {1.25, 1.5, 1.75, 2.0, 2.25}) {
      EXPECT_NEAR(valueAt(ran, floor, t), std::max(0.0, 2.0 - t) * valueAt(ran, floor, 1.0), 1e-10) << t;
      EXPECT_EQ(valueAt(ran, disc, t), 0.0) << t;
    }
  }
}

/// Whatever closes the gaps.
TEST(LeavingTool, AnElasticBodySpringsBackToWhereItWas) {
  for (const Strings& method :
       {Strings{}, Strings{"contact[0].friction=0"},
        Strings{"contact[0].friction=0", "contact[0].method=augmented-lagrangian"},
        Strings{"contact[0].method=augmented-lagrangian"}, Strings{"contact[0].method=penalty"},
        Strings{"contact[0].friction=0", "contact[0].method=pointwise-penalty"}}) {
    const Outcome ran = ranPressed("elastic", method);
    EXPECT_GT(std::abs(valueAt(ran, "middle.uy", 1.0)), 0.03);
    EXPECT_NEAR(valueAt(ran, "floor.fy", 1.25), 0.75 * valueAt(ran, "floor.fy", 1.0), 1e-9);
    EXPECT_NEAR(valueAt(ran, "middle.uy", 1.25), 0.75 * valueAt(ran, "middle.uy", 1.0), 5e-3)
        << "forces stay where they were";
    EXPECT_LT(ran.lastFrame.displacement.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(std::abs(valueAt(ran, "middle.stress_xx", 2.5)), 1e-9);
    ASSERT_EQ(ran.lastFrame.contact.size(), 1U);
    EXPECT_EQ(ran.lastFrame.contact[0].pressure.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(ran.lastFrame.contact[0].quadraturePressure.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_TRUE(ran.lastFrame.contact[0].quadratureGap.allFinite());
  }
}

TEST(LeavingTool, IsStillThereInTheFrameOfTheTimeAtWhichItLeaves) {
  const test::ScratchDirectory directory("leaving_frame");
  RunObserver silent;
  runScene(parseScene(kPressedBlock, "test.yaml", {"output.times=[1.25]"}), directory.path(), {}, silent);
  ResultReader reader(directory.path());
  int pressed = 0;
  for (int k = 0; k < reader.numFrames(); ++k) {
    const FrameRecord frame = reader.frame(k);
    const bool isPressed = frame.contact.at(0).quadraturePressure.maxCoeff() > 0.0;
    EXPECT_EQ(isPressed, frame.time == 1.0) << frame.time;
    pressed += isPressed ? 1 : 0;
  }
  EXPECT_EQ(pressed, 1);
}

/// Also where the tool moves away at once, and where springs of a penalty method go with it.
TEST(LeavingTool, TheWorkOfFadingForcesIsCounted) {
  for (const Strings& method : {Strings{}, Strings{"contact[0].method=penalty", "contact[0].parameter=20"},
                                Strings{"contact[0].method=pointwise-penalty", "contact[0].parameter=20"}}) {
    Strings changes{"steps=[{until: 1, count: 80}, {until: 2.5, count: 60}]", "contact[0].friction=0",
                    "tools[0].motion.times=[0, 0.5, 1, 1.05]", "tools[0].motion.x=[0, 0, 0.1, 0.1]",
                    "tools[0].motion.y=[0, -0.08, -0.08, 1]"};
    changes.insert(changes.end(), method.begin(), method.end());
    const Outcome ran = ranPressed("work", changes);
    const double most = valueAt(ran, "external_work", 1.0);
    EXPECT_GT(most, 0.001);
    EXPECT_LT(std::abs(valueAt(ran, "external_work", 2.5)), 3e-3 * most);
    for (const DoubtRecord& doubt : ran.summary.doubts) EXPECT_THAT(doubt.what, Not(HasSubstr("work")));
  }
}

/// Metal that unloads elastically has one state without load, whichever way the tool goes.
TEST(LeavingTool, LeavesWhatALiftedToolLeaves) {
  const std::string metal =
      replaced(kPressedBlock, "law: neo-hookean, E: 1.0, nu: 0.3",
               "law: j2, E: 1, nu: 0.3, hardening: {law: linear, sigma0: 0.02, modulus: 0.2}");
  const Outcome taken = ranPressed("taken", {"contact[0].friction=0"}, metal);
  const std::string lifted =
      replaced(replaced(metal, "    until: 1\n    released_by: 2\n", ""),
               "times: [0, 0.5, 1], x: [0, 0, 0.1], y: [0, -0.08, -0.08]",
               "times: [0, 0.5, 1, 2], x: [0, 0, 0.1, 0.1], y: [0, -0.08, -0.08, 0.1]");
  const Outcome raised = ranPressed("raised", {"contact[0].friction=0"}, lifted);
  ASSERT_GT(taken.history.column("max_plastic_strain").back(), 0.01);
  ASSERT_EQ(valueAt(taken, "max_plastic_strain", 2.5), valueAt(taken, "max_plastic_strain", 1.0))
      << "no flow behind it";
  for (const char* field : {"stress", "plastic_strain"})
    EXPECT_LT((taken.lastFrame.fields.at(field).values - raised.lastFrame.fields.at(field).values)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9)
        << field;
}

TEST(LeavingTool, OneOfTwoLeavesTheOtherAlone) {
  const std::string two = replaced(
      replaced(kPressedBlock, "contact: [",
               "  - {name: other, shape: cylinder, center: [1.6, 1.5], radius: 0.5, carry: {y: -0.02}}\n"
               "contact: [{tool: other, face: top}, "),
      ", friction: 0.3", "");
  const std::string alone =
      replaced(replaced(two, ", {tool: disc, face: top}", ""), "    until: 1\n    released_by: 2\n", "");
  const Outcome both = ranPressed("both", {}, two), single = ranPressed("single", {}, alone);
  EXPECT_LT((both.lastFrame.displacement - single.lastFrame.displacement).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(valueAt(both, "other.fy", 1.5), 0.02, 1e-10);
}

TEST(LeavingTool, StaysWhereItWasIfItWasCarried) {
  const std::string carried = replaced(replaced(kPressedBlock, "x: [0, 0, 0.1], y: [0, -0.08, -0.08]}",
                                                "x: [0, 0, 0.1]}\n    carry: {y: -0.02}"),
                                       ", friction: 0.3", "");
  const Outcome ran = ranPressed("carried", {}, carried);
  EXPECT_NEAR(valueAt(ran, "disc.fy", 1.0), 0.02, 1e-10);
  EXPECT_EQ(valueAt(ran, "disc.uy", 1.0), valueAt(ran, "disc.uy", 2.5));
  EXPECT_LT(ran.lastFrame.displacement.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LeavingTool, ARunThatIsStoppedAtEveryStepHasTheSameBits) {
  const std::string two = replaced(
      replaced(
          kPressedBlock, "contact: [",
          "  - {name: other, shape: cylinder, center: [1.6, 1.5], radius: 0.5, carry: {y: -0.02}, until: 0.75}\n"
          "contact: [{tool: other, face: top, method: penalty}, "),
      "fix: [x, y]}]", "fix: [x, y]}, {name: grip, face: left, part: [0.5, 1], fix: [x], until: 1}]");
  for (const std::string& scene : {kPressedBlock, two}) {
    const auto found =
        test::haltedAfterEveryStep(parseScene(scene, "test.yaml", {"output.every=0.4"}), "leaving");
    EXPECT_GT(found.halts, 15);
    EXPECT_EQ(found.halted, found.whole);
  }
}

TEST(LeavingTool, InSpace) {
  const std::string cube = R"(
geometry: {shape: box, size: [1, 1, 1], spans: [4, 4, 4]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{name: floor, face: bottom, fix: [x, y, z]}]
tools:
  - {name: ball, shape: sphere, center: [0.5, 1.7, 0.5], radius: 0.7, motion: {times: [0, 1], x: [0, 0.02], y: [0, -0.06]}, until: 1}
contact: [{tool: ball, face: top, friction: 0.2}]
steps: [{until: 1, count: 3}, {until: 2, count: 2}]
output: {vtu: false, reactions: true}
)";
  const Outcome ran = ranPressed("cube", {}, cube);
  EXPECT_GT(std::abs(valueAt(ran, "floor.fy", 1.0)), 0.01);
  EXPECT_NEAR(valueAt(ran, "floor.fy", 1.5), 0.5 * valueAt(ran, "floor.fy", 1.0), 1e-9);
  EXPECT_LT(ran.lastFrame.displacement.cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LeavingTool, ResultsKnowWhen) {
  const std::string name = "  - name: disc\n";
  const std::string before = "  - {name: rest, shape: plane, origin: [0, 3], normal: [0, -1]}\n";
  const Outcome ran = ranPressed(
      "record", {"steps=[{until: 1, count: 12}, {until: 1.5, count: 2}]", "tools[1].released_by=1.5"},
      replaced(kPressedBlock, name, before + name));
  ASSERT_EQ(ran.model.tools.size(), 2u);
  EXPECT_EQ(ran.model.tools[0].until, std::nullopt);
  EXPECT_EQ(ran.model.tools[1].until, 1.0);
  EXPECT_TRUE(ran.model.tools[1].isThereAt(1.0));
  EXPECT_FALSE(ran.model.tools[1].isThereAt(ran.lastFrame.time));
}

std::string errorOfPressed(const Strings& overrides) {
  try {
    buildModel<2>(parseScene(kPressedBlock, "test.yaml", overrides));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(LeavingTool, RefusesWhatMakesNoSense) {
  EXPECT_EQ(errorOfPressed({}), "no error");
  EXPECT_THAT(errorOfPressed({"tools[0].until=3"}),
              HasSubstr("tools[0].until: found 3; allowed: a time before the end of the run at 2.5"));
  EXPECT_THAT(errorOfPressed({"tools[0].released_by=1"}),
              HasSubstr("tools[0].released_by: found 1; allowed: a time after until (1)"));
  EXPECT_THAT(
      errorOfPressed(
          {"tools[0]={name: disc, shape: cylinder, center: [0.9, 1.6], radius: 0.6, released_by: 2}"}),
      HasSubstr("tools[0].released_by: found without until"));
  EXPECT_THAT(errorOfPressed(
                  {"tools[0]={name: disc, shape: cylinder, center: [0.9, 1.6], radius: 0.6, until: 1, path: "
                   "{course: polyline, points: [[0, 0], [0, -0.08], [0.1, -0.08]], speed: 0.1}}"}),
              HasSubstr("tools[0].until: found 1, before the path of the tool ends; allowed: 1.8 or later"));
}

}  // namespace
}  // namespace burnish
