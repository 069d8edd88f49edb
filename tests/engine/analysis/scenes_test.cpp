// Scenes as users write them: the examples run to their end, and scenes that cannot be computed say why.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

TEST(Examples, RunToTheirEndAndBalanceTheirEnergy) {
  for (const char* name : {"annulus_press", "block_traction", "punch_cylinder_j2"}) {
    const Scene scene = readScene(fmt::format("{}/scenes/examples/{}.yaml", BURNISH_SOURCE_DIR, name));
    const auto outcome = test::run(scene, name);
    EXPECT_TRUE(outcome.summary.completed) << name << ": " << outcome.summary.stoppedBecause;
    const auto& end = outcome.summary.end;
    EXPECT_NEAR(end.externalWork, end.strainEnergy + end.contactEnergy + end.plasticWork,
                0.005 * end.externalWork)
        << name;
  }
}

/// A disc over a coarse block; `tool` and `supports` are YAML.
Scene toolOverBlock(const std::string& tool, const std::string& supports, int steps) {
  return parseScene(fmt::format(R"(
geometry: {{shape: rectangle, size: [2, 1], functions: [8, 5]}}
material: {{law: neo-hookean, E: 1, nu: 0.3}}
supports: {}
tools: [{{name: disc, {}}}]
contact: [{{tool: disc, face: top, method: augmented-lagrangian}}]
steps: [{{until: 1, count: {}}}]
)",
                                supports, tool, steps),
                    "block.yaml");
}

Scene discOverBlock(const std::string& tool, const std::string& supports, int steps) {
  return toolOverBlock("shape: cylinder, radius: 0.5, " + tool, supports, steps);
}

std::string refusalOf(const Scene& scene) {
  const test::ScratchDirectory directory("refused");
  RunObserver silent;
  try {
    runScene(scene, directory.path(), {}, silent);
  } catch (const Error& error) {
    EXPECT_FALSE(std::filesystem::exists(directory.path())) << "nothing may be left behind";
    return error.what();
  }
  return "no error";
}

TEST(Tools, ThatPassThroughTheSurfaceStopTheRun) {
  for (const int steps : {3, 60}) {
    const auto outcome = test::run(discOverBlock("center: [1, 1.5], motion: {times: [0, 1], y: [0, -0.9]}",
                                                 "[{face: bottom, fix: [x, y]}]", steps),
                                   "deep");
    EXPECT_FALSE(outcome.summary.completed) << steps;
    for (const double force : outcome.history.column("disc.fy"))
      EXPECT_GE(force, 0.0) << "contact never pulls";
  }
}

TEST(Tools, OfPiecesThatTouchWithAFlatEndArePressed) {
  const std::string held = "[{face: bottom, fix: [x, y]}]", motion = "motion: {times: [0, 1], y: [0, -0.02]}";
  const auto punchAt = [&](double y) {
    return toolOverBlock(
        fmt::format("shape: polyline, points: [[0.6, {0}], [1.4, {0}], [1.4, 1.4], [0.6, 1.4]], {1}", y,
                    motion),
        held, 2);
  };
  const auto outcome = test::run(punchAt(1.0), "flat_end");
  ASSERT_TRUE(outcome.summary.completed) << outcome.summary.stoppedBecause;
  // More than a strip as wide as the punch takes.
  EXPECT_GT(outcome.history.column("disc.fy").back(), 0.8 * 0.02);
  const std::string refusal = refusalOf(punchAt(0.99));
  EXPECT_NE(refusal.find("tool 'disc' overlaps face 'top' by 0.01"), std::string::npos) << refusal;
}

TEST(Tools, ThatStartInsideOrCannotMoveTheirFaceAreRefused) {
  const std::string held = "[{face: bottom, fix: [x, y]}]";
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(refusalOf(discOverBlock("center: [1, 0.5]", held, 1)),
         "contact[0]: tool 'disc' is behind face 'top'");
  expect(refusalOf(discOverBlock("center: [1, 1.499999]", held, 1)), "overlaps face 'top' by 1e-06");
  expect(refusalOf(discOverBlock("center: [1, 1.5]", "[{face: top, fix: [x, y]}]", 1)),
         "held in all its components");
  expect(refusalOf(discOverBlock("center: [1, 1.5]", "[{face: bottom, fix: [y]}]", 1)), "free to move");
}

TEST(Supports, ThatMeetAtACornerMustMoveItAlike) {
  const std::string tool = "center: [1, 1.5]";
  const auto supports = [](const char* leftMotion) {
    return fmt::format("[{{face: bottom, fix: [x, y]}}, {{face: left, move: {{times: [0, 1], x: {}}}}}]",
                       leftMotion);
  };
  EXPECT_NE(refusalOf(discOverBlock(tool, supports("[0, 0.1]"), 1)).find("prescribed differently"),
            std::string::npos);
  EXPECT_TRUE(test::run(discOverBlock(tool, supports("[0, 0]"), 1), "corner").summary.completed);
}

TEST(ThreeDimensions, ABallPressedIntoABlockIsInBalance) {
  const Scene scene = parseScene(R"(
geometry: {shape: box, size: [1, 1, 0.5], spans: [5, 5, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports:
  - {face: back, fix: [x, y, z]}
  - {face: left, symmetry: true}
  - {face: bottom, symmetry: true}
tools: [{name: ball, shape: sphere, center: [0, 0, 1.0], radius: 0.5, motion: {times: [0, 1], z: [0, -0.08]}}]
contact: [{tool: ball, face: front, method: augmented-lagrangian}]
steps: [{until: 1, count: 8}]
)",
                                 "ball.yaml");
  const auto outcome = test::run(scene, "ball");
  ASSERT_TRUE(outcome.summary.completed);
  const auto& end = outcome.summary.end;
  EXPECT_NEAR(end.externalWork, end.strainEnergy, 0.02 * end.strainEnergy);
  const Eigen::Vector3d& force = end.toolForces.front();
  EXPECT_GT(force(2), 0.0);
  EXPECT_NEAR(force(0), force(1), 1e-9 * force(2)) << "the quarter model is symmetric about its diagonal";
}

}  // namespace
}  // namespace burnish
