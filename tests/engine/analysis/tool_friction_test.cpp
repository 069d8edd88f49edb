// Bodies that rub on tools: runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

/// A block that is pressed on a floor, dragged over it and back.
std::string draggedOverAFloor(const std::string& keys) {
  return fmt::format(R"(
degree: 2
geometry: {{shape: rectangle, size: [1, 1], spans: [4, 4]}}
material: {{law: neo-hookean, E: 10, nu: 0.3}}
supports:
  - {{face: top, move: {{times: [0, 1, 2, 3], x: [0, 0, 0.5, 0], y: [0, -0.05, -0.05, -0.05]}}}}
tools: [{{name: floor, shape: plane, origin: [0, 0], normal: [0, 1]}}]
contact: [{{tool: floor, face: bottom, {}}}]
steps: [{{until: 1, count: 5}}, {{until: 2, count: 20}}, {{until: 3, count: 20}}]
)",
                     keys);
}

TEST(ToolFriction, ABlockThatSlidesHasForcesInTheRatioOfFriction) {
  for (const char* method : {"penalty", "pointwise-penalty", "augmented-lagrangian"})
    for (const double mu : {0.1, 0.5}) {
      const auto outcome = test::run(
          parseScene(draggedOverAFloor(fmt::format("method: {}, friction: {}", method, mu)), "floor"),
          "dragged_over_a_floor");
      ASSERT_TRUE(outcome.summary.completed) << method << outcome.summary.stoppedBecause;
      const auto& fx = outcome.history.column("floor.fx");
      const auto& fy = outcome.history.column("floor.fy");
      const auto& sticking = outcome.history.column("floor.sticking");
      int sliding = 0;
      for (std::size_t k = 6; k < fx.size(); ++k) {
        if (sticking[k] > 0.0) {
          EXPECT_LT(std::abs(fx[k] / fy[k]), mu);
          continue;
        }
        ++sliding;
        EXPECT_NEAR(std::abs(fx[k] / fy[k]), mu, 1e-10) << method << " in row " << k;
      }
      EXPECT_GT(sliding, 20) << method;
      EXPECT_LT(fx[25] * fx.back(), 0.0) << "the way back";
      const auto& end = outcome.summary.end;
      EXPECT_NEAR((end.strainEnergy + end.contactEnergy + outcome.history.column("friction_work").back()) /
                      end.externalWork,
                  1.0, 2e-3)
          << method;
    }
}

/// A plate that a load presses on a block is dragged along it.
TEST(ToolFriction, ALoadThatIsDraggedAlongIsHeldBackByFriction) {
  for (const char* method :
       {"augmented-lagrangian", "integral-augmented-lagrangian", "penalty", "pointwise-penalty"}) {
    const auto outcome = test::run(parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: rectangle, size: [2, 1], spans: [8, 4]}}
material: {{law: neo-hookean, E: 10, nu: 0.3}}
supports: [{{face: bottom, fix: [x, y]}}]
tools: [{{name: plate, shape: plane, origin: [0, 1.2], normal: [0, -1], prescribe: {{x: 't <= 1 ? 0 : 0.6*(t - 1)'}},
         carry: {{y: 't < 1 ? -0.4*t : -0.4'}}}}]
contact: [{{tool: plate, face: top, friction: 0.2, method: {}}}]
steps: [{{until: 1, count: 4}}, {{until: 2, count: 12}}]
)",
                                                          method),
                                              "plate"),
                                   "dragged_load");
    ASSERT_TRUE(outcome.summary.completed) << method << outcome.summary.stoppedBecause;
    EXPECT_EQ(outcome.history.column("plate.sticking").back(), 0.0) << method;
    EXPECT_NEAR(outcome.history.column("plate.fy").back(), 0.4, 1e-8) << method;
    EXPECT_NEAR(std::abs(outcome.history.column("plate.fx").back()), 0.08, 1e-8) << method;
  }
}

}  // namespace
}  // namespace burnish
