#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Runs in space whose fine spans follow a tool.
namespace burnish {
namespace {

using samples::replaced;
using test::Outcome;

/// Half of a block that a ball is drawn along, in a symmetric half.
const std::string kBlock = R"(
geometry: {shape: box, origin: [-0.6, -0.5, 0], size: [2.1, 0.5, 0.5], resolution: {along: ball, half_width: 0.15, spans_per_width: 3, growth: 2}}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports: [{face: bottom, fix: [x, y, z]}, {face: back, symmetry: true}]
tools:
  - name: ball
    shape: sphere
    center: [0, 1, 0]
    radius: 1
    path: {course: raster, start: [0, -0.02, 0], stroke: [0.9, 0, 0], speed: 1, clearance: [0, 0.03, 0]}
contact: [{tool: ball, face: top}]
rezoning: {travel: 0.3}
steps: [{until: 0.96, count: 16}]
output: {vtu: false}
)";

Outcome ran(const std::string& scene, const std::string& name) {
  return test::run(parseScene(scene, "test.yaml"), "regraded_" + name);
}

/// Largest difference of a column at the times that both runs have, over the largest value.
double largestDifference(const Outcome& run, const Outcome& reference, const std::string& column) {
  std::map<long, double> values;  // of the reference, by time
  const auto &times = reference.history.column("time"), &all = reference.history.column(column);
  for (std::size_t k = 0; k < times.size(); ++k) values[std::lround(1e6 * times[k])] = all[k];
  double difference = 0.0;
  std::size_t compared = 0;
  for (std::size_t k = 0; k < run.history.numRows(); ++k)
    if (const auto found = values.find(std::lround(1e6 * run.history.column("time")[k]));
        found != values.end()) {
      difference = std::max(difference, std::abs(run.history.column(column)[k] - found->second));
      ++compared;
    }
  EXPECT_EQ(compared, times.size());
  return difference / *std::max_element(all.begin(), all.end());
}

TEST(RegradedRun, OfAnElasticBodyIsThatOfAMeshThatIsFineAllAlong) {
  const Outcome followed = ran(kBlock, "followed"),
                fine = ran(replaced(kBlock, "rezoning: {travel: 0.3}\n", ""), "fine");
  ASSERT_TRUE(followed.summary.completed) << followed.summary.stoppedBecause;
  EXPECT_EQ(followed.summary.rezonings.size(), 2u);
  EXPECT_EQ(followed.summary.failedRezonings, 0) << followed.summary.rezoningFailure;
  EXPECT_LT(followed.summary.unknowns, 0.8 * fine.summary.unknowns);
  for (const char* column : {"ball.fy", "strain_energy", "external_work"})
    EXPECT_LT(largestDifference(followed, fine, column), 0.002) << column;
  EXPECT_NEAR(followed.history.column("strain_energy").back(), 0.0, 1e-12) << "once the ball is lifted";
  for (const auto& rezoning : followed.summary.rezonings) {
    EXPECT_LT(std::abs(rezoning.volumeDrift), 1e-12) << "nothing has flowed";
    EXPECT_NEAR(rezoning.energyLost, 0.0, 1e-3 * 0.0021);
  }
}

const std::string kElastic = "material: {law: neo-hookean, E: 100, nu: 0.3}";
const std::string kMetal =
    "material: {law: j2, E: 100, nu: 0.3, hardening: {law: voce, sigma0: 0.5, sigma_inf: 0.8, beta: 10}}";

/// What the track loses on the coarse spans behind the ball, two spans over the width of the contact: of four it is a
/// third (docs/rezoning.md).
TEST(RegradedRun, OfMetalIsNearlyThatOfAMeshThatIsFineAllAlong) {
  const std::string metal = replaced(kBlock, kElastic, kMetal);
  const Outcome followed = ran(metal, "metal"),
                fine = ran(replaced(metal, "rezoning: {travel: 0.3}\n", ""), "fine_metal");
  ASSERT_TRUE(followed.summary.completed) << followed.summary.stoppedBecause;
  EXPECT_EQ(followed.summary.rezonings.size(), 2u);
  EXPECT_LT(largestDifference(followed, fine, "ball.fy"), 0.02);
  EXPECT_LT(largestDifference(followed, fine, "plastic_work"), 0.035);
  EXPECT_GT(fine.history.column("max_plastic_strain").back(), 0.2);
}

/// Two tracks one behind the other in metal, and a mesh for each, which changes while the ball is in the air.
const std::string kTracks =
    replaced(replaced(replaced(kBlock, kElastic, kMetal), "stroke: [0.9, 0, 0], speed: 1",
                      "stroke: [0.3, 0, 0], feed: [0.6, 0, 0], passes: 2, speed: 1"),
             "rezoning: {travel: 0.3}\nsteps: [{until: 0.96, count: 16}]",
             "rezoning: {travel: 0.35}\nsteps: [{until: 1.02, count: 17}]");

TEST(RegradedRun, GainsNoPlasticStrainWhereNothingPresses) {
  const Outcome outcome = ran(kTracks, "tracks");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  ASSERT_EQ(outcome.summary.rezonings.size(), 1u);
  const auto& history = outcome.history;
  const auto& count = history.column("rezonings");
  const auto after = static_cast<std::size_t>(std::find(count.begin(), count.end(), 1.0) - count.begin());
  ASSERT_EQ(history.column("ball.fy")[after - 1], 0.0);
  ASSERT_EQ(history.column("ball.fy")[after], 0.0);
  const auto gain = [&](const char* column) {
    return history.column(column)[after] / history.column(column)[after - 1] - 1.0;
  };
  EXPECT_GT(history.column("max_plastic_strain")[after], 0.2);
  EXPECT_LT(gain("max_plastic_strain"), 1e-3);
  EXPECT_LT(gain("plastic_work"), 2e-3) << "what flows while the body comes into equilibrium";
  EXPECT_GE(gain("plastic_work"), 0.0);
  EXPECT_LT(std::abs(outcome.summary.rezonings.front().volumeDrift), 5e-4);
  EXPECT_EQ(outcome.summary.rezonings.front().gapWork, 0.0);
  EXPECT_NEAR(history.column("rezoning_energy_lost").back(), outcome.summary.rezonings.front().energyLost,
              1e-15);
}

TEST(RegradedRun, HasFramesOfItsMeshesOverOneReference) {
  const Outcome outcome = ran(kTracks, "frames");
  ASSERT_TRUE(outcome.lastFrame.mesh);
  const PatchRecord &first = outcome.model.mesh.patches.front(),
                    &last = outcome.lastFrame.mesh->patches.front();
  EXPECT_NE(first.directions[0].knots, last.directions[0].knots);
  EXPECT_EQ(first.directions[1].knots, last.directions[1].knots);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(first.points.row(d).minCoeff(), last.points.row(d).minCoeff());
    EXPECT_EQ(first.points.row(d).maxCoeff(), last.points.row(d).maxCoeff());
  }
  EXPECT_EQ(outcome.lastFrame.displacement.cols(), last.points.cols());
  EXPECT_LT(outcome.lastFrame.displacement.row(1).minCoeff(), -0.005) << "the first track is still there";
}

/// A short, coarse block of metal with back stresses.
const std::string kShort = replaced(
    replaced(
        replaced(replaced(kBlock, "material: {law: neo-hookean, E: 100, nu: 0.3}",
                          "material: {law: chaboche, E: 100, nu: 0.3, hardening: {law: voce, sigma0: "
                          "0.5, sigma_inf: 0.8, beta: 10}, back_stresses: [{modulus: 10, recovery: 30}]}"),
                 "origin: [-0.6, -0.5, 0], size: [2.1, 0.5, 0.5]",
                 "origin: [-0.4, -0.4, 0], size: [1.5, 0.4, 0.4]"),
        "stroke: [0.9, 0, 0]", "stroke: [0.6, 0, 0]"),
    "growth: 2}", "growth: 2.5}");

/// The ball rubs.
const std::string kRubbedInSpace =
    replaced(replaced(kShort, "contact: [{tool: ball, face: top}]\nrezoning: {travel: 0.3}",
                      "contact: [{tool: ball, face: top, method: integral-augmented-lagrangian, friction: "
                      "0.1}]\nrezoning: {travel: 0.22}"),
             "until: 0.96, count: 16", "until: 0.66, count: 11");

/// The ball is pressed on by a force.
const std::string kPressed =
    replaced(replaced(kShort,
                      "path: {course: raster, start: [0, -0.02, 0], stroke: [0.6, 0, 0], speed: 1, "
                      "clearance: [0, 0.03, 0]}",
                      "carry: {y: -0.06}\n    path: {course: raster, start: [0, -0.04, 0], stroke: [0.6, "
                      "0, 0], speed: 1, clearance: [0, 0.06, 0], ramp: 0.1}"),
             "rezoning: {travel: 0.3}\nsteps: [{until: 0.96, count: 16}]",
             "rezoning: {travel: 0.22}\nsteps: [{until: 0.72, count: 12}]");

/// The block is held at its right end until shortly before the first change of the mesh is due, and let go beyond that.
const std::string kHeld = replaced(
    kShort, "{face: back, symmetry: true}]",
    "{face: back, symmetry: true}, {name: grip, face: right, fix: [x], until: 0.18, released_by: 0.36}]");

constexpr std::array kNamesOfResumed{"Friction", "Force", "LetGo"};

class ResumedRegrading : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Scenes, ResumedRegrading, testing::Values(kRubbedInSpace, kPressed, kHeld),
                         [](const auto& test) { return kNamesOfResumed[test.index]; });

TEST_P(ResumedRegrading, HasTheSameBits) {
  const test::HaltedHistory history =
      test::haltedAfterEveryStep(parseScene(GetParam(), "test.yaml"), "regraded_halts");
  EXPECT_GT(history.halts, 10);
  EXPECT_EQ(history.whole, history.halted);
  EXPECT_THAT(history.whole, testing::HasSubstr("rezoning_gap_work"));
}

TEST(RegradedRun, LeavesTheMeshAloneWhileASupportLetsGo) {
  const auto elastic = [](const std::string& scene, const std::string& name) {
    return test::run(parseScene(scene, "test.yaml",
                                {"material={law: neo-hookean, E: 100, nu: 0.3}", "output.reactions=true"}),
                     "regraded_" + name);
  };
  const Outcome free = elastic(kShort, "free"), held = elastic(kHeld, "held");
  ASSERT_TRUE(held.summary.completed) << held.summary.stoppedBecause;
  ASSERT_EQ(free.summary.rezonings.size(), held.summary.rezonings.size());
  EXPECT_EQ(held.summary.failedRezonings, 0) << held.summary.rezoningFailure;
  EXPECT_GT(free.summary.rezonings.front().time, 0.18);
  EXPECT_LT(free.summary.rezonings.front().time, 0.36 - 1e-9);
  EXPECT_NEAR(held.summary.rezonings.front().time, 0.36, 1e-9);
  // An elastic body forgets what has been let go.
  std::map<long, double> energies;
  for (std::size_t k = 0; k < free.history.numRows(); ++k)
    energies[std::lround(1e6 * free.history.column("time")[k])] = free.history.column("strain_energy")[k];
  int compared = 0;
  for (std::size_t k = 0; k < held.history.numRows(); ++k) {
    const double time = held.history.column("time")[k];
    if (time < 0.37 || !energies.contains(std::lround(1e6 * time))) continue;
    EXPECT_NEAR(held.history.column("strain_energy")[k], energies.at(std::lround(1e6 * time)), 1e-10);
    EXPECT_NEAR(held.history.column("grip.fx")[k], 0.0, 1e-10);
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(RegradedRun, CarriesAForceAcrossMeshes) {
  const Outcome outcome = ran(kPressed, "force");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  ASSERT_EQ(outcome.summary.rezonings.size(), 2u);
  const auto& time = outcome.history.column("time");
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] > 0.17 && time[k] < 0.55) {
      EXPECT_NEAR(outcome.history.column("ball.fy")[k], 0.06, 1e-8 * 0.06) << time[k];
    }
}

}  // namespace
}  // namespace burnish
