#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/results/summary_file.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Forces of the body on its supports: with those on tools they add up to the loads.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::replaced;
using test::bytes;
using test::Outcome;
using test::ScratchDirectory;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using Strings = std::vector<std::string>;

/// Two supports that share a corner, a load, and a disc that goes down and up again.
const std::string kPlane = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {name: floor, face: bottom, fix: [x, y]}
  - {face: left, symmetry: true}
loads: [{face: right, traction: [0.02*t, 0.01*t]}]
tools:
  - {name: disc, shape: cylinder, center: [1.2, 1.5], radius: 0.5, motion: {times: [0, 1, 2], y: [0, -0.08, -0.06]}}
contact: [{tool: disc, face: top}]
solver: {tolerance: 1e-12}
steps: [{until: 2, count: 6}]
output: {every: 0.7, vtu: false, reactions: true}
)";

const std::string kSolid = R"(
geometry: {shape: box, size: [1, 1, 1], spans: [3, 3, 3]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {face: back, fix: [x, y, z]}
  - {face: left, symmetry: true}
loads: [{face: right, traction: [0.02*t, 0.01*t, -0.03*t]}]
tools:
  - {name: ball, shape: sphere, center: [0.4, 0.6, 1.5], radius: 0.5, motion: {times: [0, 1], z: [0, -0.15]}}
contact: [{tool: ball, face: front}]
solver: {tolerance: 1e-12}
steps: [{until: 1, count: 2}]
output: {vtu: false, reactions: true}
)";

const std::string kRing = R"(
geometry: {shape: rectangle, size: [1, 1], spans: [6, 4]}
kinematics: axisymmetric
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {face: bottom, fix: [x, y]}
  - {face: left, symmetry: true}
loads: [{face: right, traction: [0, 0.01*t]}]
tools:
  - {name: ball, shape: cylinder, center: [0, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.08]}}
contact: [{tool: ball, face: top}]
solver: {tolerance: 1e-12}
steps: [{until: 1, count: 2}]
output: {vtu: false, reactions: true}
)";

Outcome ranScene(const std::string& yaml, const std::string& name, const Strings& overrides = {}) {
  return test::run(parseScene(yaml, "test.yaml", overrides), "reactions_" + name);
}

/// Sum of columns at the last row.
double sumAtEnd(const HistoryTable& history, const Strings& columns) {
  double sum = 0.0;
  for (const std::string& column : columns) sum += history.column(column).back();
  return sum;
}

/// The same relative to the largest of them.
double imbalance(const HistoryTable& history, const Strings& columns, double load) {
  double largest = std::abs(load);
  for (const std::string& column : columns)
    largest = std::max(largest, std::abs(history.column(column).back()));
  return (sumAtEnd(history, columns) - load) / largest;
}

constexpr double kBalance = 1e-10;

TEST(Reactions, BalanceToolsAndLoadsInThePlane) {
  const HistoryTable history = ranScene(kPlane, "plane").history;
  EXPECT_GT(history.column("disc.fy").back(), 0.001);
  EXPECT_LT(std::abs(imbalance(history, {"floor.fx", "support2.fx", "disc.fx"}, 0.04)), kBalance);
  EXPECT_LT(std::abs(imbalance(history, {"floor.fy", "support2.fy", "disc.fy"}, 0.02)), kBalance);
  EXPECT_THAT(history.column("support2.fy"), Each(0.0)) << "it lets slide";
  EXPECT_NE(history.column("support2.fx").back(), 0.0);
}

TEST(Reactions, HaveTheSignOfToolForces) {
  const HistoryTable history = ranScene(kPlane, "sign", {"loads=[]"}).history;
  EXPECT_GT(history.column("disc.fy").back(), 0.0);
  EXPECT_LT(history.column("floor.fy").back(), 0.0) << "the body presses down on the floor";
}

TEST(Reactions, BalanceMomentsAboutTheOrigin) {
  const HistoryTable history = ranScene(kPlane, "moment", {"loads=[]"}).history;
  const double x = 1.2, y = 1.5 + history.column("disc.uy").back();
  const double tool = history.column("disc.mz").back() + x * history.column("disc.fy").back() -
                      y * history.column("disc.fx").back();
  EXPECT_GT(std::abs(tool), 0.001);
  EXPECT_NEAR(sumAtEnd(history, {"floor.mz", "support2.mz"}), -tool, kBalance * std::abs(tool));
}

TEST(Reactions, BalanceToolsAndLoadsInSpace) {
  const HistoryTable history = ranScene(kSolid, "solid").history;
  EXPECT_GT(history.column("ball.fz").back(), 0.001);
  EXPECT_LT(std::abs(imbalance(history, {"support1.fx", "support2.fx", "ball.fx"}, 0.02)), kBalance);
  EXPECT_LT(std::abs(imbalance(history, {"support1.fy", "support2.fy", "ball.fy"}, 0.01)), kBalance);
  EXPECT_LT(std::abs(imbalance(history, {"support1.fz", "support2.fz", "ball.fz"}, -0.03)), kBalance);
}

TEST(Reactions, BalanceMomentsInSpace) {
  const HistoryTable history = ranScene(kSolid, "solid_moment", {"loads=[]"}).history;
  const auto vector = [&](const std::string& name) {
    return Eigen::Vector3d(history.column(name + "x").back(), history.column(name + "y").back(),
                           history.column(name + "z").back());
  };
  const Eigen::Vector3d pivot = Eigen::Vector3d(0.4, 0.6, 1.5) + vector("ball.u");
  const Eigen::Vector3d tool = vector("ball.m") + pivot.cross(vector("ball.f"));
  EXPECT_GT(tool.norm(), 0.001);
  EXPECT_LT((vector("support1.m") + vector("support2.m") + tool).norm(), kBalance * tool.norm());
}

TEST(Reactions, AreThoseOfTheWholeRingInAxisymmetry) {
  const Outcome ran = ranScene(kRing, "ring");
  EXPECT_LT(std::abs(imbalance(ran.history, {"support1.fy", "support2.fy", "ball.fy"},
                               0.01 * 2.0 * std::numbers::pi)),
            kBalance);
  EXPECT_THAT(ran.history.column("support1.fx"), Each(0.0)) << "radial forces balance one another";
  EXPECT_THAT(ran.history.columns, Not(Contains("support1.mz")));
  EXPECT_TRUE(ran.summary.reactions.front().moment.empty());
}

TEST(Reactions, ASharedComponentBelongsToTheFirstSupportThatHoldsIt) {
  const std::string twice = replaced(kPlane, "face: left, symmetry: true", "face: bottom, fix: [y]");
  const HistoryTable history = ranScene(twice, "twice").history;
  EXPECT_THAT(history.column("support2.fy"), Each(0.0));
  EXPECT_LT(std::abs(imbalance(history, {"floor.fy", "disc.fy"}, 0.02)), kBalance);
}

TEST(Reactions, AreInTheHistoryOnDemandAndInTheSummaryAlways) {
  const Outcome with = ranScene(kPlane, "with"),
                without = ranScene(kPlane, "without", {"output.reactions=false"});
  for (const std::string& column : without.history.columns) {
    EXPECT_THAT(column, Not(HasSubstr("floor")));
    EXPECT_EQ(with.history.column(column), without.history.column(column)) << column;
  }
  EXPECT_EQ(with.history.columns.size(), without.history.columns.size() + 6);
  ASSERT_EQ(without.summary.reactions.size(), 2u);
  const ReactionRecord& floor = without.summary.reactions.front();
  EXPECT_EQ(floor.support, "floor");
  EXPECT_EQ(floor.place, "bottom");
  EXPECT_EQ(floor.force[1], with.history.column("floor.fy").back());
  EXPECT_EQ(floor.moment[0], with.history.column("floor.mz").back());
}

TEST(Reactions, TheLargestIsThatOfAllSteps) {
  const Outcome ran = ranScene(kPlane, "largest", {"loads=[]"});
  double largest = 0.0, time = 0.0;
  for (std::size_t k = 0; k < ran.history.numRows(); ++k) {
    const double force =
        Eigen::Vector3d(ran.history.column("floor.fx")[k], ran.history.column("floor.fy")[k], 0.0).norm();
    if (force > largest) time = ran.history.column("time")[k];
    largest = std::max(largest, force);
  }
  EXPECT_EQ(time, 1.0) << "where the disc is deepest";
  EXPECT_EQ(ran.summary.reactions.front().largest, largest);
  EXPECT_EQ(ran.summary.reactions.front().largestTime, time);
}

/// What is wrong with the scene in the plane after changes.
std::string errorOf(const Strings& overrides, const std::string& more = "") {
  try {
    parseScene(kPlane + more, "test.yaml", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Reactions, HaveColumnsOfTheirOwn) {
  EXPECT_THAT(
      errorOf({"supports[0].name=disc"}),
      HasSubstr("supports[0]: found the name disc, which another support, a body, a tool or a measure has"));
  EXPECT_EQ(errorOf({"supports[0].name=disc", "output.reactions=false"}), "no error");
  EXPECT_THAT(errorOf({"supports[0].name=support2", "output.reactions=false"}),
              HasSubstr("supports[1]: found the name support2"));
}

TEST(Reactions, OfAResumedRunAreThoseOfOneThatWasNotStopped) {
  const ScratchDirectory whole("reactions_whole"), part("reactions_part");
  const Scene scene = parseScene(kPlane, "test.yaml");
  RunObserver silent;
  runScene(scene, whole.path(), {}, silent);
  const auto haltAfterTwo = [] {
    return RunOptions{.threads = 1, .halt = [taken = 0]() mutable { return ++taken >= 2; }};
  };
  RunSummary summary = runScene(scene, part.path(), haltAfterTwo(), silent);
  for (int halts = 0; summary.halted && halts < 100; ++halts)
    summary = resumeRun(readResultScene(part.path()), part.path(), haltAfterTwo(), silent);
  ASSERT_TRUE(summary.completed);
  EXPECT_EQ(bytes(part.path() / "history.csv"), bytes(whole.path() / "history.csv"));
  const auto expected = readSummary(whole.path()).reactions, found = readSummary(part.path()).reactions;
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].force, expected[k].force);
    EXPECT_EQ(found[k].moment, expected[k].moment);
    EXPECT_EQ(found[k].largest, expected[k].largest);
    EXPECT_EQ(found[k].largestTime, expected[k].largestTime);
  }
}

TEST(Reactions, GoOnOverNewMeshes) {
  const Outcome ran = ranScene(samples::ironing + "rezoning: {travel: 0.1, spans: [32, 8]}\n", "rezoned",
                               {"output.reactions=true", "solver.tolerance=1e-11"});
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  ASSERT_GE(ran.summary.rezonings.size(), 2u);
  EXPECT_LT(std::abs(imbalance(ran.history, {"support1.fy", "disc.fy"}, 0.0)), 1e-8);
  EXPECT_LT(std::abs(imbalance(ran.history, {"support1.fx", "disc.fx"}, 0.0)), 1e-8);
  const auto& fx = ran.history.column("support1.fx");
  const auto& fy = ran.history.column("support1.fy");
  double largest = 0.0;
  for (std::size_t k = 0; k < fx.size(); ++k)
    largest = std::max(largest, Eigen::Vector3d(fx[k], fy[k], 0.0).norm());
  EXPECT_GE(ran.summary.reactions.front().largest, largest) << "of all meshes";
}

}  // namespace
}  // namespace burnish
