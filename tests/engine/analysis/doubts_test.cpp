// What a run says about answers that it should not be believed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/results/doubts.h"
#include "tests/engine/analysis/run_scene.h"

namespace burnish {
namespace {

using testing::HasSubstr;

bool hasDoubt(const RunSummary& summary, const std::string& text) {
  return std::any_of(summary.doubts.begin(), summary.doubts.end(),
                     [&](const DoubtRecord& doubt) { return doubt.what.find(text) != std::string::npos; });
}

/// How far work and what became of it are apart at the end.
double imbalanceOf(const StateQuantities& end) {
  return burnish::imbalanceOf(end.energyFound(), end.externalWork, end.largestEnergy);
}

/// A block of 2 x 1 into which a disc of radius 0.5 goes 0.9 deep.
Scene deepDisc(int steps, const std::string& tool = "shape: cylinder, center: [1, 1.5], radius: 0.5") {
  return parseScene(R"(
geometry: {shape: rectangle, size: [2, 1], functions: [21, 11]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, )" +
                        tool + R"(, motion: {times: [0, 1], y: [0, -0.9]}}]
contact: [{tool: disc, face: top, method: augmented-lagrangian}]
steps: [{until: 1, count: )" +
                        std::to_string(steps) + "}]\n",
                    "deep disc");
}

TEST(Passage, AToolThatGoesFurtherThanItsRadiusInOneStepStaysInFrontOfTheSurface) {
  const auto once = test::run(deepDisc(1), "once"), often = test::run(deepDisc(20), "often");
  ASSERT_TRUE(once.summary.completed);
  EXPECT_GT(once.summary.cuts, 0);
  EXPECT_NEAR(once.history.column("disc.fy").back(), often.history.column("disc.fy").back(), 1e-6);
}

TEST(Passage, AToolThatGoesAllTheWayThroughIsNotLost) {
  // Far enough for the disc to come out below the body, where no gap is negative any more.
  Scene scene = deepDisc(1);
  scene.tools.front().motion->y = std::vector<double>{0.0, -3.0};
  const auto outcome = test::run(scene, "through");
  EXPECT_FALSE(outcome.summary.completed);
  EXPECT_GT(outcome.history.column("disc.fy").back(), 1.0);
}

TEST(PeakContact, AForceOnOneOrTwoControlPointsIsDoubted) {
  const auto pressed = [](int functions, double depth) {
    Scene scene = deepDisc(4);
    scene.body.geometry.mesh.functions = {functions, 11};
    scene.tools.front().motion->y = std::vector<double>{0.0, depth};
    scene.contact.front().options.method = Enforcement::IntegralAugmentedLagrangian;
    return test::run(scene, "pressed");
  };
  const std::string carried =
      "the largest force of contact \"disc\" is carried by fewer than three control points";
  const auto coarse = pressed(9, -0.002);
  ASSERT_TRUE(hasDoubt(coarse.summary, carried));
  EXPECT_EQ(coarse.summary.doubts.front().detail, "1 control point");
  const auto fine = pressed(121, -0.002);
  EXPECT_FALSE(hasDoubt(fine.summary, carried));
  EXPECT_LT(coarse.history.column("disc.fy").back(), 0.6 * fine.history.column("disc.fy").back());
  // With half a span of contact the force is 2 % off.
  const auto resolved = pressed(13, -0.03);
  EXPECT_FALSE(hasDoubt(resolved.summary, carried));
  EXPECT_NEAR(resolved.history.column("disc.fy").back(), pressed(121, -0.03).history.column("disc.fy").back(),
              4e-4);
  // The first states of a contact that grows are carried by few on any mesh.
  EXPECT_FALSE(hasDoubt(pressed(21, -0.4).summary, carried));
}

/// An elastic block that is pressed in a few steps and let go of gives all work back; the error of its sum does not.
TEST(Balance, ABlockThatIsLetGoOfIsJudgedByTheWorkThatItHeld) {
  Scene scene = deepDisc(8);
  scene.tools.front().motion->times = {0.0, 0.5, 1.0};
  scene.tools.front().motion->y = std::vector<double>{0.0, -0.4, 0.0};
  const auto outcome = test::run(scene, "released");
  ASSERT_TRUE(outcome.summary.completed);
  const StateQuantities& end = outcome.summary.end;
  EXPECT_LT(end.energyFound(), 1e-6 * end.largestEnergy);
  EXPECT_LT(imbalanceOf(end), 0.05);
  EXPECT_FALSE(hasDoubt(outcome.summary, "work and energies"));
}

/// A disc that is drawn over a block at a depth, in passes that are each by `lift` higher.
test::Outcome drawnOver(double lift, int passes, const std::string& name, double clearance = 0.1) {
  return test::run(parseScene(fmt::format(R"(
geometry: {{shape: rectangle, size: [2, 1], functions: [21, 11]}}
material: {{law: neo-hookean, E: 1, nu: 0.3}}
supports: [{{face: bottom, fix: [x, y]}}]
tools:
  - {{name: disc, shape: cylinder, center: [0.8, 1.5], radius: 0.5,
      path: {{course: raster, start: [0, -0.02], stroke: [0.4, 0], feed: [0, {}], passes: {}, speed: 1, clearance: [0, {}]}}}}
contact: [{{tool: disc, face: top, method: augmented-lagrangian}}]
steps: [{{until: {}, count: {}}}]
)",
                                          lift, passes, clearance, 1.2 * passes, 24 * passes),
                              name),
                   name);
}

TEST(Passes, ThatTouchNothingAreDoubted) {
  const auto low = drawnOver(0.0, 2, "low"), high = drawnOver(0.05, 3, "high");
  EXPECT_FALSE(hasDoubt(low.summary, "touches nothing"));
  ASSERT_TRUE(hasDoubt(high.summary, "disc touches nothing in a pass"));
  const auto& doubts = high.summary.doubts;
  const auto doubt = std::find_if(doubts.begin(), doubts.end(), [](const DoubtRecord& one) {
    return one.what.find("touches nothing") != std::string::npos;
  });
  EXPECT_EQ(doubt->detail, "2 of 3 passes");
}

TEST(Passes, WhoseToolStillTouchesWhenItIsLiftedAreDoubted) {
  // The second pass is 0.03 deeper than the first.
  const auto off = drawnOver(-0.03, 2, "off"), held = drawnOver(-0.03, 2, "held", 0.03);
  EXPECT_FALSE(hasDoubt(off.summary, "still touches"));
  EXPECT_TRUE(hasDoubt(held.summary, "disc still touches when it has been lifted"));
}

TEST(Stability, AColumnAboveItsBucklingLoadIsDoubted) {
  // Cantilever of length 2 and width 0.1: P_cr = pi^2 E I / (4 l^2) = 0.0514 for E = 1000.
  const auto column = [](double traction) {
    return test::run(parseScene(R"(
geometry: {shape: rectangle, size: [0.1, 2], functions: [4, 22]}
material: {law: neo-hookean, E: 1000, nu: 0}
supports: [{face: bottom, fix: [x, y]}]
loads: [{face: top, traction: ["0", "-)" +
                                    std::to_string(traction) + R"(*t"]}]
steps: [{until: 1, count: 20}]
)",
                                "column"),
                     "column");
  };
  EXPECT_FALSE(hasDoubt(column(0.9 * 0.514).summary, "unstable"));
  const auto buckled = column(1.1 * 0.514);
  ASSERT_TRUE(hasDoubt(buckled.summary, "unstable"));
  EXPECT_NEAR(buckled.summary.doubts.front().firstTime, 1.0 / 1.1, 0.051);  // a step
  EXPECT_THAT(buckled.summary.doubts.front().detail, HasSubstr("in up to 1 direction "));
  // At 90 times the load the modes with (2 k - 1)^2 < 90 are unstable: k = 1 ... 5.
  const auto far = column(90.0 * 0.514);
  ASSERT_TRUE(hasDoubt(far.summary, "unstable"));
  EXPECT_THAT(far.summary.doubts.front().detail, HasSubstr("in up to 5 directions "));
}

/// A block below a plate that goes down by 0.2.
Scene belowPlate(const std::string& contact, const std::string& more) {
  return parseScene(R"(
geometry: {shape: rectangle, size: [2, 1], functions: [9, 5]}
material: {law: neo-hookean, E: 1, nu: 0.3}
tools:
  - {name: lid, shape: plane, origin: [0, 1], normal: [0, -1], motion: {times: [0, 1, 2], y: [0, -0.1, -0.2]}}
  - {name: seat, shape: plane, origin: [0, 0], normal: [0, 1]}
steps: [{until: 1, count: 5}, {until: 2, count: 5}]
contact: )" + contact + "\n" +
                        more,
                    "below plate");
}

const char* const kBetweenPlates = "[{tool: lid, face: top}, {tool: seat, face: bottom}]";

TEST(Stabilisation, ABodyThatOnlyContactHoldsGetsTheForceOfOneThatIsHeld) {
  const auto held =
      test::run(belowPlate("[{tool: lid, face: top}]",
                           "supports: [{face: left, symmetry: true}, {face: bottom, symmetry: true}]"),
                "held");
  const auto loose = test::run(belowPlate(kBetweenPlates, "stabilise: {}"), "loose");
  ASSERT_TRUE(loose.summary.completed);
  const double force = held.history.column("lid.fy").back();
  EXPECT_GT(force, 0.1);
  EXPECT_NEAR(loose.history.column("lid.fy").back(), force, 1e-6 * force);
  EXPECT_NEAR(loose.history.column("seat.fy").back(), -force, 1e-6 * force);
  EXPECT_LT(loose.summary.end.stabilisedShare, 1e-6);
  EXPECT_FALSE(hasDoubt(loose.summary, "stabilisation"));
  EXPECT_THROW(test::run(belowPlate(kBetweenPlates, ""), "refused"), Error);
}

TEST(Stabilisation, ADragThatIsNotNegligibleIsDoubtedAndItsWorkIsCounted) {
  const auto outcome =
      test::run(belowPlate(kBetweenPlates, "stabilise: {strength: 0.1, until: 4}"), "dragged");
  ASSERT_TRUE(hasDoubt(outcome.summary, "stabilisation"));
  EXPECT_GT(outcome.summary.largestStabilisedShare.value(), 0.01);
  EXPECT_GT(outcome.summary.end.stabilisationWork, 0.0);
  EXPECT_LT(imbalanceOf(outcome.summary.end), 0.05);
  StateQuantities without = outcome.summary.end;
  without.stabilisationWork = 0.0;
  EXPECT_GT(imbalanceOf(without), imbalanceOf(outcome.summary.end));
}

TEST(Balance, ALoadThatIsThereAtOnceIsNoReasonToDoubt) {
  const auto outcome = test::run(parseScene(R"(
geometry: {shape: rectangle, size: [1, 1], functions: [4, 4]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: left, symmetry: true}, {face: bottom, symmetry: true}]
loads: [{face: right, traction: [0.001, 0]}]
steps: [{until: 1, count: 1}]
)",
                                            "at once"),
                                 "at_once");
  EXPECT_NEAR(imbalanceOf(outcome.summary.end), 0.5, 0.01);  // what the history says
  EXPECT_FALSE(hasDoubt(outcome.summary, "work and energies"));
}

TEST(Balance, ABodyThatIsLetGoOfIsNoReasonToDoubt) {
  const auto outcome = test::run(parseScene(R"(
geometry: {shape: rectangle, size: [2, 1], functions: [20, 6]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - {name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1, 2], y: [0, -0.01, 0]}}
contact: [{tool: disc, face: top}]
steps: [{until: 2, count: 8}]
)",
                                            "let go"),
                                 "let_go");
  EXPECT_LT(outcome.summary.end.energyFound(), 1e-12 * outcome.summary.end.largestEnergy);
  EXPECT_FALSE(hasDoubt(outcome.summary, "work and energies"));
}

}  // namespace
}  // namespace burnish
