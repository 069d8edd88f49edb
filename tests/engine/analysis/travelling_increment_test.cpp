#include "engine/analysis/travelling_increment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/analysis/build_model.h"
#include "tests/engine/analysis/run_scene.h"

/// Increments of a step that go along with a tool over a face.
namespace burnish {
namespace {

/// Spans of 0.25 along x and y; the tool goes by one of them along x in a unit of time, and down.
const std::string kTravelledBlock = R"(
geometry: {shape: box, size: [2, 1.5, 0.5], spans: [8, 6, 2]}
material: {law: neo-hookean, E: 100, nu: 0.3}
supports: [{face: back, fix: [x, y, z]}]
tools: [{name: ball, shape: sphere, center: [0.3, 0.7, 1], radius: 0.5, motion: {times: [0, 4], x: [0, 1], z: [0, -0.1]}}]
contact: [{tool: ball, face: front, friction: 0.2}]
steps: [{until: 4, count: 4}]
)";

Scene travelledScene(const std::vector<std::string>& overrides = {}) {
  return parseScene(kTravelledBlock, "test.yaml", overrides);
}

/// Number of a function of the block, 10 x 8 x 4 of degree 2.
int functionAt(int i, int j, int k) {
  return i + 10 * (j + 8 * k);
}

TEST(TravellingIncrement, MovesByASpan) {
  const auto model = buildModel<3>(travelledScene());
  const int first = model->contacts().front().term->firstMultiplier(), count = 10 * 8;
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(model->numUnknowns()), expected = increment;
  // All coefficients of one line far from its ends: those of the same function, a span further on.
  const auto set = [&](Eigen::VectorXd& x, int i) {
    for (int c = 0; c < 3; ++c) x(3 * functionAt(i, 3, 2) + c) = 1.0 + c;
    x(first + i + 10 * 3) = -4.0;
    for (int c = 0; c < 2; ++c) x(first + count + 2 * (i + 10 * 3) + c) = 5.0 + c;
  };
  set(increment, 4);
  set(expected, 5);
  // The middles of the steps from 1 to 2 and from 2 to 3 are a span apart.
  TravellingIncrement<3>(*model).move(1.0, 3.0, increment);
  // Beyond the uniform knots the collocation of the whole line feels its ends.
  EXPECT_LT((increment - expected).cwiseAbs().maxCoeff(), 0.02);
}

TEST(TravellingIncrement, LeavesMotionsOfTheWholeBodyAsTheyAre) {
  const auto model = buildModel<3>(travelledScene());
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(model->numUnknowns());
  for (int a = 0; a < model->body().numNodes; ++a) increment.segment(3 * a, 3) << 0.1, -0.2, 0.3;
  const Eigen::VectorXd before = increment;
  TravellingIncrement<3>(*model).move(0.0, 1.3, increment);
  EXPECT_LT((increment - before).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(TravellingIncrement, GoesAlongATurnedFaceAndBackwards) {
  const std::vector<std::string> back = {"tools[0].motion={times: [0, 4], y: [0, -1], z: [0, -0.1]}"};
  const auto model = buildModel<3>(travelledScene(back));
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(model->numUnknowns()), expected = increment;
  increment(3 * functionAt(4, 4, 1)) = expected(3 * functionAt(4, 3, 1)) = 1.0;
  TravellingIncrement<3>(*model).move(1.0, 3.0, increment);
  EXPECT_LT((increment - expected).cwiseAbs().maxCoeff(), 0.02);
}

TEST(TravellingIncrement, StaysWhereNoCoordinateFollowsAParameter) {
  const auto model =
      buildModel<3>(travelledScene({"geometry={shape: box, size: [2, 1.5, 0.5], spans: [8, 6, 2]}",
                                    "tools[0].motion={times: [0, 4], z: [0, -0.1]}"}));
  const Eigen::VectorXd before = Eigen::VectorXd::Random(model->numUnknowns());
  Eigen::VectorXd increment = before;
  TravellingIncrement<3>(*model).move(1.0, 3.0, increment);
  EXPECT_EQ(increment, before);
}

/// 78 iterations; 103 with increments that go on where they were.
TEST(TravellingIncrement, SparesIterationsOfABallThatRolls) {
  const auto rolled = test::run(parseScene(R"(
geometry: {shape: box, size: [2.4, 1.2, 0.6], spans: [16, 8, 3]}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 0.5, modulus: 5}}
supports: [{face: back, fix: [x, y, z]}]
tools:
  - {name: ball, shape: sphere, center: [0.6, 0.6, 1.6], radius: 1, carry: {z: -0.3, spin: true, schedule: {times: [0, 1], values: [0.01, 1]}},
     motion: {times: [1, 3], x: [0, 1.2]}}
contact: [{tool: ball, face: front, friction: 0.2}]
steps: [{until: 1, count: 4}, {until: 3, count: 12}]
output: {vtu: false}
)",
                                           "test.yaml", {}),
                                "travelling");
  ASSERT_TRUE(rolled.summary.completed) << rolled.summary.stoppedBecause;
  EXPECT_EQ(rolled.summary.cuts, 0);
  EXPECT_LT(rolled.summary.iterations, 88);
}

}  // namespace
}  // namespace burnish
