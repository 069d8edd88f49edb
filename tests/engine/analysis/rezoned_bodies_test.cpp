#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Runs of several bodies one of which is meshed anew under way.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::replaced;
using test::bytes;
using test::haltAfter;
using test::last;
using test::runTo;
using test::ScratchDirectory;
using testing::HasSubstr;

const std::string kSlab = R"(
geometry: {shape: rectangle, size: [2.0, 0.6], functions: [30, 8]}
material:
  law: j2
  E: 70000
  nu: 0.3
  hardening: {law: voce, sigma0: 79.66, sigma_inf: 171.26, beta: 17.8}
)";

/// A body that flows while it is pressed flat, until t = 1, and rests from then on.
const std::string kRestingBlock = replaced(kSlab, "size: [2.0, 0.6], functions: [30, 8]",
                                           "origin: [5, 0], size: [1.0, 1.0], functions: [7, 6]");

std::string inList(const std::string& name, std::string body) {
  for (std::size_t at = 0; (at = body.find('\n', at)) + 1 < body.size(); at += 4)
    body.replace(at, 1, "\n    ");
  return "\n  - name: " + name + body;
}

/// The ironing of `samples::ironing` beside a block that nothing touches.
std::string beside(bool slabIsFirst) {
  const std::string slab = inList("slab", kSlab), block = inList("block", kRestingBlock);
  std::string scene =
      replaced(samples::ironing, kSlab, "bodies:" + (slabIsFirst ? slab + block : block + slab));
  scene = replaced(scene, "supports: [{face: bottom, fix: [x, y]}]", R"(supports:
  - {body: slab, face: bottom, fix: [x, y]}
  - {body: block, face: bottom, fix: [x, y]}
  - {body: block, face: top, move: {times: [0, 1, 2], y: [0, -0.05, -0.05]}})");
  return replaced(scene, "{tool: disc, face: top", "{tool: disc, body: slab, face: top");
}

class BesideAnother : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Orders, BesideAnother, testing::Bool(),
                         [](const auto& test) { return test.param ? "First" : "Second"; });

TEST_P(BesideAnother, ABodyIsMeshedAnewAsIfItWereAlone) {
  const ScratchDirectory alone("beside_alone"), both("beside_both"), still("beside_still");
  const RunSummary one = runTo(alone.path(), samples::ironing + "rezoning: {travel: 0.1, spans: [32, 8]}\n");
  const std::string scene = beside(GetParam());
  const RunSummary two = runTo(both.path(), scene + "rezoning: {body: slab, travel: 0.1, spans: [32, 8]}\n");
  runTo(still.path(), scene);
  ASSERT_TRUE(two.completed) << two.stoppedBecause;
  ASSERT_GE(two.rezonings.size(), 3u);
  EXPECT_EQ(two.failedRezonings, 0) << two.rezoningFailure;
  EXPECT_EQ(two.rezonedBody, "slab");
  ASSERT_EQ(one.rezonings.size(), two.rezonings.size());
  const auto near = [](double value, double expected) {
    EXPECT_NEAR(value, expected, 1e-9 * std::abs(expected));
  };
  for (std::size_t k = 0; k < one.rezonings.size(); ++k) {
    near(two.rezonings[k].time, one.rezonings[k].time);
    near(two.rezonings[k].quality, one.rezonings[k].quality);
    near(two.rezonings[k].smallestSpan, one.rezonings[k].smallestSpan);
  }
  const HistoryTable slab = readHistory(alone.path() / "history.csv");
  const HistoryTable block = readHistory(still.path() / "history.csv");
  const HistoryTable history = readHistory(both.path() / "history.csv");
  for (const char* column : {"disc.fx", "disc.fy"}) near(last(history, column), last(slab, column));
  for (const char* column : {"strain_energy", "plastic_work", "max_plastic_strain", "min_detJ"}) {
    SCOPED_TRACE(column);
    near(last(history, fmt::format("slab.{}", column)), last(slab, column));
    near(last(history, fmt::format("block.{}", column)), last(block, fmt::format("block.{}", column)));
  }
  ASSERT_GT(last(history, "block.plastic_work"), 0.0);

  // Frames hold the meshes of both bodies, the block's as the model has it.
  const ResultReader result(both.path());
  const ModelRecord model = result.model();
  const FrameRecord end = result.frame(result.numFrames() - 1);
  ASSERT_TRUE(end.mesh);
  const std::size_t slabPatch = GetParam() ? 0 : 1, blockPatch = 1 - slabPatch;
  EXPECT_EQ(end.mesh->numNodes, 34 * 10 + 7 * 6);
  EXPECT_EQ(end.mesh->patches[slabPatch].points.cols(), 34 * 10);
  EXPECT_NEAR(end.mesh->patches[slabPatch].points.row(0).maxCoeff(), 2.0, 2e-3);
  EXPECT_EQ(end.mesh->patches[blockPatch].points, model.mesh.patches[blockPatch].points);
  for (const std::size_t patch : {slabPatch, blockPatch})
    EXPECT_EQ(end.mesh->patches[patch].body, static_cast<int>(patch));
  double lowest = 0.0;
  for (const int node : end.mesh->patches[blockPatch].nodes)
    lowest = std::min(lowest, end.displacement(1, node));
  EXPECT_NEAR(lowest, -0.05, 1e-12);
}

/// An elastic punch, an exact arc, is pressed into an elastic slab and dragged along it.
const std::string kPunch = R"(
bodies:
  - name: slab
    geometry: {shape: rectangle, size: [2.4, 1], spans: [36, 10]}
    material: {law: neo-hookean, E: 1, nu: 0.3}
  - name: punch
    geometry:
      shape: control-net
      degrees: [2, 1]
      knots: [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]
      points: [[0.4669872981077807, 1.25], [0.9, 0.5], [1.3330127018922193, 1.25],
               [0.4669872981077807, 1.5], [0.9, 1.5], [1.3330127018922193, 1.5]]
      weights: [1, 0.5, 1, 1, 0.5, 1]
      refine: [16, 4]
    material: {law: neo-hookean, E: 3, nu: 0.3}
supports:
  - {name: ground, body: slab, face: bottom, fix: [x, y]}
  - {name: grip, body: punch, face: top, move: {times: [0, 1, 2], x: [0, 0, 0.5], y: [0, -0.1, -0.1]}}
contact: [{PAIR, reach: 0.3, method: METHOD}]
steps: [{until: 1, count: 5}, {until: 2, count: 20}]
output: {reactions: true, every: 0.5}
)";

const std::string kIntegral = "integral-augmented-lagrangian", kAveraged = "augmented-lagrangian";

std::string pressed(const std::string& slave, const std::string& friction,
                    const std::string& method = kIntegral) {
  const std::string slab = "body: slab, face: top", punch = "body: punch, face: bottom";
  const std::string pair =
      slave == "slab" ? slab + ", against: {" + punch + "}" : punch + ", against: {" + slab + "}";
  return replaced(replaced(kPunch, "PAIR", pair + (friction == "0" ? "" : ", friction: " + friction)),
                  "METHOD", method);
}

const std::string kRezoning = "rezoning: {body: slab, travel: 0.08}\n";

/// Slave, friction and method.
class RezonedPairs : public testing::TestWithParam<std::tuple<const char*, const char*, std::string>> {
 protected:
  std::string scene() const {
    const auto& [slave, friction, method] = GetParam();
    return pressed(slave, friction, method);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Elastic, RezonedPairs,
    testing::Values(std::tuple{"punch", "0", kIntegral}, std::tuple{"punch", "0.3", kIntegral},
                    std::tuple{"slab", "0", kIntegral}, std::tuple{"slab", "0.3", kIntegral},
                    std::tuple{"punch", "0.3", kAveraged}, std::tuple{"slab", "0", kAveraged}),
    [](const auto& test) {
      return fmt::format("{}{}{}", std::get<0>(test.param),
                         std::get<1>(test.param)[1] == '\0' ? "Smooth" : "Rubs",
                         std::get<2>(test.param) == kIntegral ? "Integral" : "Averaged");
    });

TEST_P(RezonedPairs, ActAsOnOneMesh) {
  const ScratchDirectory fixed("pair_fixed"), rezoned("pair_rezoned");
  ASSERT_TRUE(runTo(fixed.path(), scene()).completed);
  const RunSummary summary = runTo(rezoned.path(), scene() + kRezoning);
  ASSERT_TRUE(summary.completed) << summary.stoppedBecause;
  ASSERT_GE(summary.rezonings.size(), 5u);
  EXPECT_EQ(summary.failedRezonings, 0) << summary.rezoningFailure;
  const HistoryTable one = readHistory(fixed.path() / "history.csv");
  const HistoryTable many = readHistory(rezoned.path() / "history.csv");
  const bool rubs = std::string(std::get<1>(GetParam())) != "0";
  const double force = last(one, "grip.fy");
  EXPECT_NEAR(last(many, "grip.fy"), force, 0.01 * std::abs(force));
  EXPECT_NEAR(last(many, "grip.fx"), last(one, "grip.fx"),
              0.01 * (rubs ? std::abs(last(one, "grip.fx")) : force));
  for (const std::string column : {"external_work", "strain_energy"})
    EXPECT_NEAR(last(many, column) / last(one, column), 1.0, 0.01) << column;
  if (rubs) {
    const auto& work = many.column("friction_work");
    EXPECT_NEAR(work.back() / last(one, "friction_work"), 1.0, 0.01);
    EXPECT_TRUE(std::is_sorted(work.end() - 20, work.end()));  // of the slide
  }

  // Forces balance in every row, on every mesh.
  for (const char* axis : {".fx", ".fy"})
    for (std::size_t k = 0; k < many.column("time").size(); ++k)
      EXPECT_NEAR(many.column(std::string("grip") + axis)[k] + many.column(std::string("ground") + axis)[k],
                  0.0, 1e-9 * std::abs(force));
}

TEST(RezonedPair, ResumesWithTheSameBitsFromAnyMesh) {
  for (const char* slave : {"punch", "slab"}) {
    const std::string scene = replaced(replaced(pressed(slave, "0.3"), "spans: [36, 10]", "spans: [24, 6]"),
                                       "refine: [16, 4]", "refine: [10, 2]") +
                              "rezoning: {body: slab, travel: 0.1, spans: [26, 6]}\n";
    const ScratchDirectory whole("pair_whole"), part("pair_part");
    const RunSummary summary = runTo(whole.path(), scene);
    ASSERT_TRUE(summary.completed) << summary.stoppedBecause;
    ASSERT_GE(summary.rezonings.size(), 3u);
    RunSummary resumed = runTo(part.path(), scene, haltAfter(3, 1));
    RunObserver silent;
    for (int halts = 0; resumed.halted; ++halts) {
      ASSERT_LT(halts, 100);
      resumed = resumeRun(readResultScene(part.path()), part.path(), haltAfter(3, 2), silent);
    }
    EXPECT_TRUE(resumed.completed);
    for (const auto& entry : fs::recursive_directory_iterator(whole.path())) {
      if (!entry.is_regular_file() || entry.path().filename() == "summary.yaml") continue;
      EXPECT_EQ(bytes(entry.path()), bytes(part.path() / fs::relative(entry.path(), whole.path())))
          << slave << entry.path();
    }
  }
}

TEST(RezonedPair, SaysWhatItCannotCarry) {
  using samples::errorOf;
  EXPECT_EQ(errorOf(pressed("slab", "0.3") + kRezoning), "no error");
  EXPECT_EQ(errorOf(pressed("punch", "0.3", kAveraged) + kRezoning), "no error");
  EXPECT_THAT(
      errorOf(pressed("slab", "0.3", kAveraged) + kRezoning),
      HasSubstr("contact[0].friction: found friction with augmented-lagrangian on the body that is meshed "
                "anew (integral-augmented-lagrangian carries it over, and so does naming the other body "
                "first)"));
  EXPECT_THAT(errorOf(pressed("slab", "0") + "rezoning: {}\n"),
              HasSubstr("rezoning.body: missing; allowed: slab | punch."));
  EXPECT_THAT(errorOf(pressed("slab", "0") + "rezoning: {body: slap}\n"),
              HasSubstr("rezoning.body: found slap; allowed: slab | punch. Did you mean \"slab\"?"));
  EXPECT_THAT(
      errorOf(
          replaced(pressed("slab", "0") + kRezoning, "steps:",
                   "loads: [{body: punch, face: left, pressure: 0}, {body: slab, face: left, pressure: 0}]\n"
                   "steps:")),
      testing::AllOf(HasSubstr("loads[1]: found a load on the body"), testing::Not(HasSubstr("loads[0]"))));
  EXPECT_THAT(errorOf(replaced(pressed("slab", "0") + kRezoning, "against: {body: punch, face: bottom}",
                               "against: {body: slab, face: left}")),
              HasSubstr("contact[0].against: found contact of two faces of the body that is meshed anew"));
}

}  // namespace
}  // namespace burnish
