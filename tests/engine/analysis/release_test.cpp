#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/analysis/build_model.h"
#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"

/// Supports that let go: their forces fade, in balance, and what is left obeys the other supports alone.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::replaced;
using test::bytes;
using test::Outcome;
using test::ScratchDirectory;
using testing::HasSubstr;
using Strings = std::vector<std::string>;

/// A block on a floor whose right face is moved out and up, and let go.
const std::string kReleased = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], spans: [4, 2]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports:
  - {name: floor, face: bottom, fix: [x, y]}
  - {name: grip, face: right, part: [0.5, 1], move: {times: [0, 1], x: [0, 0.2], y: [0, 0.1]}, until: 1, released_by: 2}
measures: [{name: end, kind: point, parameters: [1, 1], fields: [displacement, stress]}]
solver: {tolerance: 1e-12}
steps: [{until: 1, count: 4}, {until: 2.5, count: 6}]
output: {vtu: false, reactions: true}
)";

Outcome ranBlock(const std::string& yaml, const std::string& name, const Strings& overrides = {}) {
  return test::run(parseScene(yaml, "test.yaml", overrides), "release_" + name);
}

/// Row of the history at a time.
std::size_t rowAt(const HistoryTable& history, double time) {
  const auto& times = history.column("time");
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - time) < 1e-9) return k;
  throw Error("no such time");
}

TEST(Release, ForcesOfASupportThatLetsGoFadeLinearly) {
  const HistoryTable history = ranBlock(kReleased, "fade").history;
  const auto& fx = history.column("grip.fx");
  const double held = fx[rowAt(history, 1.0)];
  EXPECT_GT(std::abs(held), 0.01);
  for (const double t : {1.25, 1.5, 1.75, 2.0, 2.25})
    EXPECT_NEAR(fx[rowAt(history, t)], std::max(0.0, 2.0 - t) * held, 1e-11) << t;
}

TEST(Release, TheOtherSupportsBalanceWhatIsLeftAtEveryStep) {
  const HistoryTable history = ranBlock(kReleased, "balance").history;
  for (std::size_t k = 0; k < history.numRows(); ++k)
    for (const char* force : {"fx", "fy"})
      EXPECT_NEAR(
          history.column(std::string("grip.") + force)[k] + history.column(std::string("floor.") + force)[k],
          0.0, 1e-11)
          << force << " in row " << k;
}

TEST(Release, AnElasticBodySpringsBackToWhereItWas) {
  const Outcome ran = ranBlock(kReleased, "elastic");
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  EXPECT_LT(ran.lastFrame.displacement.cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT(std::abs(ran.history.column("end.stress_xx").back()), 1e-10);
}

TEST(Release, TheWorkOfFadingForcesIsCounted) {
  const Outcome ran = ranBlock(kReleased, "work", {"steps=[{until: 1, count: 40}, {until: 2.5, count: 60}]"});
  const auto& work = ran.history.column("external_work");
  const double most = work[rowAt(ran.history, 1.0)];
  EXPECT_GT(most, 0.001);
  EXPECT_LT(std::abs(work.back()), 1e-3 * most);
  EXPECT_TRUE(ran.summary.doubts.empty());
}

TEST(Release, WithoutAnEndItTakesTheRestOfTheRun) {
  const HistoryTable history =
      ranBlock(replaced(kReleased, ", released_by: 2", ""), "rest", {"steps[1].until=3"}).history;
  const auto& fx = history.column("grip.fx");
  EXPECT_NEAR(fx[rowAt(history, 2.0)], 0.5 * fx[rowAt(history, 1.0)], 1e-11);
  EXPECT_NEAR(fx.back(), 0.0, 1e-11);
}

TEST(Release, AComponentThatAnotherSupportHoldsStays) {
  const std::string held =
      replaced(kReleased, "measures:", "  - {face: right, part: [0.5, 1], fix: [y]}\nmeasures:");
  const Outcome ran = ranBlock(replaced(held, ", y: [0, 0.1]", ", y: [0, 0]"), "stays");
  EXPECT_NEAR(ran.history.column("end.uy").back(), 0.0, 1e-15);
  EXPECT_GT(std::abs(ran.history.column("support3.fy")[rowAt(ran.history, 1.0)]), 1e-3)
      << "it belongs to the support that holds it longer";
}

/// A second cycle of a load on a metal that has flowed is elastic.
TEST(Release, ElasticUnloadingAndLoadingAgainReturnsToTheState) {
  const std::string metal = replaced(
      replaced(kReleased, ", until: 1, released_by: 2", ", until: 9.5"), "law: neo-hookean, E: 1.0, nu: 0.3",
      "law: j2, E: 1, nu: 0.3, hardening: {law: linear, sigma0: 0.01, modulus: 0.1}");
  const Outcome ran =
      ranBlock(replaced(metal, "measures:",
                        "loads: [{face: top, traction: [0.004, 0.02], schedule: {times: [0, 1, 2, 3], "
                        "values: [0, 1, 0, 1]}}]\nmeasures:"),
               "again",
               {"supports[1].move.x=[0, 0]", "supports[1].move.y=[0, 0]", "measures[0].parameters=[0.5, 1]",
                "steps=[{until: 1, count: 8}, {until: 3, count: 2}, {until: 10, count: 1}]"});
  ASSERT_TRUE(ran.summary.completed) << ran.summary.stoppedBecause;
  ASSERT_GT(ran.history.column("max_plastic_strain").back(), 1e-3);
  for (const char* column : {"end.ux", "end.uy", "end.stress_xx", "strain_energy", "max_plastic_strain"}) {
    const auto& values = ran.history.column(column);
    const double first = values[rowAt(ran.history, 1.0)];
    EXPECT_NEAR(values[rowAt(ran.history, 3.0)], first, 1e-10 * std::abs(first)) << column;
    EXPECT_EQ(std::string(column) == "max_plastic_strain", values[rowAt(ran.history, 2.0)] == first)
        << column;
  }
}

TEST(Release, ARunThatIsStoppedAtEveryStepHasTheSameBits) {
  const ScratchDirectory whole("release_whole"), part("release_part");
  const Scene scene = parseScene(kReleased, "test.yaml", {"output.every=0.5"});
  RunObserver silent;
  runScene(scene, whole.path(), {}, silent);
  const RunOptions haltAtOnce{.threads = 1, .halt = [] { return true; }};
  RunSummary summary = runScene(scene, part.path(), haltAtOnce, silent);
  int halts = 0;
  for (; summary.halted && halts < 100; ++halts)
    summary = resumeRun(readResultScene(part.path()), part.path(), haltAtOnce, silent);
  ASSERT_TRUE(summary.completed);
  EXPECT_GT(halts, 5);
  EXPECT_EQ(bytes(part.path() / "history.csv"), bytes(whole.path() / "history.csv"));
}

/// What is wrong with the block after changes.
std::string errorOfBlock(const Strings& overrides, const std::string& yaml = kReleased) {
  try {
    buildModel<2>(parseScene(yaml, "test.yaml", overrides));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Release, AsksFormulasForNothingBehindIt) {
  const std::string root = replaced(kReleased, "move: {times: [0, 1], x: [0, 0.2], y: [0, 0.1]}",
                                    "prescribe: {x: 0.1 - 0.1*sqrt(1 - t)}");
  EXPECT_EQ(errorOfBlock({}, root), "no error");
  EXPECT_THAT(errorOfBlock({"supports[1].until=1.5"}, root), HasSubstr("supports[1].prescribe: "));
}

TEST(Release, RefusesWhatMakesNoSense) {
  EXPECT_EQ(errorOfBlock({}), "no error");
  EXPECT_THAT(errorOfBlock({"supports[1].until=3"}),
              HasSubstr("supports[1].until: found 3; allowed: a time before the end of the run at 2.5"));
  EXPECT_THAT(errorOfBlock({"supports[1].released_by=1"}),
              HasSubstr("supports[1].released_by: found 1; allowed: a time after until (1)"));
  EXPECT_THAT(errorOfBlock({"supports[0].released_by=1"}),
              HasSubstr("supports[0].released_by: found without until"));
  EXPECT_THAT(
      errorOfBlock({"supports[0].until=1.5"}),
      HasSubstr("supports[0].until: the supports leave the body free to move as a rigid whole in 3 ways "
                "behind t = 1.5; hold more components or faces"));
  EXPECT_THAT(errorOfBlock({"supports[1].until=1.5", "supports[0].fix=[y]"}),
              HasSubstr("in 1 way behind t = 1.5"));
}

}  // namespace
}  // namespace burnish
