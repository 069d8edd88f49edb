// Where tools stand when a run begins.
#include "engine/analysis/place_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/analysis/build_model.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

Scene coarseIroning(const std::string& basis) {
  return readScene(
      std::string(BURNISH_SOURCE_DIR) + "/scenes/paper/plastic.yaml",
      {"pictures=[]", "geometry.functions=[25, 13]", "steps=[{until: 0.2, count: 2}]", "basis=" + basis});
}

/// A disc above a block, which carries a load.
Scene discAboveBlock(const std::string& carry, const std::string& friction = "0") {
  return parseScene(fmt::format(R"(
degree: 2
geometry: {{shape: rectangle, origin: [0, 0], size: [2, 1], spans: [8, 4]}}
material: {{law: neo-hookean, E: 10.0, nu: 0.3}}
supports: [{{face: bottom, fix: [x, y]}}]
tools: [{{name: disc, shape: cylinder, center: [1, 1.8], radius: 0.5, carry: {{{}}}}}]
contact: [{{tool: disc, face: top, friction: {}}}]
steps: [{{until: 1, count: 4}}]
)",
                                carry, friction),
                    "disc");
}

double smallestGapAt(const Model<2>& model, const ToolPose& pose) {
  return model.contacts().front().term->smallestReferenceGap(gapTo(*model.tools().front(), pose));
}

TEST(PlaceTools, ALagrangeToolThatMerelyTouchesIsLiftedAndComesDownBeforeTheStart) {
  const auto model = buildModel<2>(coarseIroning("lagrange"));
  const Tool& tool = *model->tools().front();
  ASSERT_LT(model->startTime(), 0.0);
  EXPECT_LT(smallestGapAt(*model, tool.pose(0.0)), 0.0) << "the reason to lift it: negative lobes";
  EXPECT_GT(smallestGapAt(*model, tool.pose(model->startTime())), 0.0);
  EXPECT_GT(tool.pose(model->startTime()).displacement(1), 0.0);
  EXPECT_EQ(tool.pose(0.0).displacement.norm(), 0.0);
}

TEST(PlaceTools, SplinesHaveNoNegativeLobesAndNeedNoLift) {
  const auto model = buildModel<2>(coarseIroning("nurbs"));
  EXPECT_EQ(model->startTime(), 0.0);
  EXPECT_EQ(model->tools().front()->lift.norm(), 0.0);
}

TEST(PlaceTools, AToolThatCarriesALoadBeginsInTouchWithTheBody) {
  const auto model = buildModel<2>(discAboveBlock("y: '-t'"));
  const Tool& tool = *model->tools().front();
  const SteppingState& start = model->startState();
  EXPECT_EQ(start.time, 0.0);
  const ToolPose pose = tool.pose(start.time, start.x);
  EXPECT_LE(pose.displacement(1), -0.3) << "the distance between them";
  EXPECT_GT(pose.displacement(1), -0.4);
  EXPECT_EQ(pose.displacement(0), 0.0);
  EXPECT_NEAR(smallestGapAt(*model, pose), 0.0, 1e-8);
}

TEST(PlaceTools, AToolThatOnlyTurnsFreelyAndInItselfNeedNotTouch) {
  const auto model = buildModel<2>(discAboveBlock("moment: 0", "0.3"));
  EXPECT_NEAR(smallestGapAt(*model, model->tools().front()->pose(0.0)), 0.3, 0.1) << "it stays where it is";
}

TEST(PlaceTools, ALoadThatLeadsAwayFromTheBodyIsRefused) {
  try {
    buildModel<2>(discAboveBlock("y: 't'"));
    FAIL() << "the disc moves away";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("tools[0].carry"), std::string::npos) << message;
    EXPECT_NE(message.find("does not meet its face"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace burnish
