#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "engine/analysis/build_model.h"
#include "engine/analysis/scene_report.h"
#include "engine/core/error.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/two_bodies_sample.h"

/// Several bodies in one scene against each of them in a scene of its own.
namespace burnish {
namespace {

using test::Outcome;
using testing::HasSubstr;
using testing::Not;

/// One of the bodies of the sample in a scene of its own.
Scene alone(const std::string& body, const std::string& measures) {
  return parseScene(body + R"(
supports: [{face: bottom, fix: [x, y]}]
tools:
  - {name: plate, shape: plane, origin: [0, 1], normal: [0, -1], motion: {times: [0, 1], y: [0, -0.04]}}
contact: [{tool: plate, face: top}]
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 4}]
output: {every: 0.5, reactions: true}
)" + measures,
                    "alone.yaml");
}

Scene softAlone() {
  return alone(R"(
formulation: fbar
degree: 2
geometry: {shape: rectangle, size: [1, 1], spans: [4, 3]}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 5}}
)",
               R"(
measures:
  - {name: foot, kind: face, face: bottom}
  - {name: tall, kind: percentile, field: plastic_strain, share: 0.9}
)");
}

Scene firmAlone() {
  return alone(
      R"(
basis: lagrange
degree: 3
quadrature_points: 5
geometry: {shape: rectangle, origin: [1.5, 0], size: [0.5, 1], spans: [2, 3]}
material: {law: neo-hookean, E: 300, nu: 0.2}
)",
      "measures: [{name: corner, kind: point, position: [2, 1], fields: [displacement, von_mises]}]");
}

/// What the two bodies give together, and each alone; run once.
class TwoBodies : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    both_ = new Outcome(test::run(parseScene(samples::twoBodies, "both.yaml"), "two_bodies"));
    soft_ = new Outcome(test::run(softAlone(), "soft_alone"));
    firm_ = new Outcome(test::run(firmAlone(), "firm_alone"));
  }
  static void TearDownTestSuite() {
    for (const Outcome** outcome : {&both_, &soft_, &firm_}) {
      delete *outcome;
      *outcome = nullptr;
    }
  }

  /// Whether a column of both is, in every row, that of the outcomes alone, added.
  static void expectSum(const std::string& column, const std::string& alone,
                        const std::vector<const Outcome*>& outcomes) {
    const auto& values = both_->history.column(column);
    ASSERT_EQ(values.size(), 5u);
    for (std::size_t row = 0; row < values.size(); ++row) {
      double sum = 0.0;
      for (const Outcome* outcome : outcomes) sum += outcome->history.column(alone)[row];
      EXPECT_NEAR(values[row], sum, 1e-9 * std::abs(sum)) << column << " in row " << row;
    }
  }
  static void expectSame(const std::string& column, const std::string& alone, const Outcome& outcome) {
    expectSum(column, alone, {&outcome});
  }

  static const Outcome *both_, *soft_, *firm_;
};
const Outcome *TwoBodies::both_, *TwoBodies::soft_, *TwoBodies::firm_;

TEST_F(TwoBodies, TheSampleFlowsAndTouches) {
  EXPECT_TRUE(both_->summary.completed);
  EXPECT_GT(soft_->history.column("max_plastic_strain").back(), 0.01);
  EXPECT_GT(std::abs(firm_->history.column("plate.fy").back()), 1.0);
}

TEST_F(TwoBodies, SumsAreThoseOfTheBodiesAlone) {
  for (const char* column : {"strain_energy", "external_work", "plastic_work", "plate.fy"})
    expectSum(column, column, {soft_, firm_});
  expectSame("max_plastic_strain", "max_plastic_strain", *soft_);
  expectSame("max_plastic_strain_projected", "max_plastic_strain_projected", *soft_);
  EXPECT_EQ(both_->history.column("active_control_points").back(),
            soft_->history.column("active_control_points").back() +
                firm_->history.column("active_control_points").back());
}

TEST_F(TwoBodies, EachBodyHasItsOwnColumns) {
  expectSame("soft.strain_energy", "strain_energy", *soft_);
  expectSame("firm.strain_energy", "strain_energy", *firm_);
  expectSame("soft.plastic_work", "plastic_work", *soft_);
  expectSame("soft.max_plastic_strain", "max_plastic_strain", *soft_);
  expectSame("firm.min_detJ", "min_detJ", *firm_);
  EXPECT_EQ(both_->history.column("firm.plastic_work").back(), 0.0);
  EXPECT_THAT(soft_->history.columns, Not(testing::Contains(HasSubstr(".strain_energy"))));
}

TEST_F(TwoBodies, ReactionsAndMeasuresAreOfTheNamedBody) {
  expectSame("support1.fy", "support1.fy", *soft_);
  expectSame("support2.fy", "support1.fy", *firm_);
  expectSame("foot.fy", "foot.fy", *soft_);
  expectSame("tall.value", "tall.value", *soft_);
  expectSame("corner.ux", "corner.ux", *firm_);
  expectSame("corner.von_mises", "corner.von_mises", *firm_);
  EXPECT_EQ(both_->summary.reactions.at(1).place, "bottom of body firm");
}

TEST_F(TwoBodies, FramesHoldTheFieldsOfBothBodyAfterBody) {
  const FrameRecord &both = both_->lastFrame, &soft = soft_->lastFrame, &firm = firm_->lastFrame;
  const Eigen::Index softNodes = soft.displacement.cols(), softPoints = soft.quadrature.positions.cols();
  EXPECT_EQ(both_->model.bodies, (std::vector<std::string>{"soft", "firm"}));
  EXPECT_EQ(both_->model.mesh.patches.at(0).body, 0);
  EXPECT_EQ(both_->model.mesh.patches.at(1).body, 1);
  EXPECT_LT((both.displacement.leftCols(softNodes) - soft.displacement).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((both.displacement.rightCols(firm.displacement.cols()) - firm.displacement).cwiseAbs().maxCoeff(),
            1e-11);
  const auto& stress = both.fields.at("stress").values;
  EXPECT_TRUE(stress.leftCols(softNodes).isApprox(soft.fields.at("stress").values, 1e-8));
  EXPECT_TRUE(stress.rightCols(firm.displacement.cols()).isApprox(firm.fields.at("stress").values, 1e-8));
  EXPECT_TRUE(both.fields.at("stress").bodies.empty());
  const FieldRecord& strain = both.fields.at("plastic_strain");
  EXPECT_EQ(strain.bodies, std::vector<std::string>{"soft"});
  EXPECT_TRUE(strain.values.leftCols(softNodes).isApprox(soft.fields.at("plastic_strain").values, 1e-8));
  EXPECT_TRUE(strain.values.rightCols(firm.displacement.cols()).isZero(0.0));

  EXPECT_EQ(both.quadrature.numPoints, (std::vector<int>{static_cast<int>(softPoints), 6 * 25}));
  EXPECT_TRUE(both.quadrature.positions.rightCols(6 * 25).isApprox(firm.quadrature.positions, 1e-11));
  EXPECT_TRUE(both.quadrature.fields.at("J").values.rightCols(6 * 25).isApprox(
      firm.quadrature.fields.at("J").values, 1e-9));
  ASSERT_EQ(both.contact.size(), 2u);
  EXPECT_EQ(both.contact[1].patch, 1);
  EXPECT_TRUE(both.contact[1].pressure.isApprox(firm.contact[0].pressure, 1e-8));
}

/// A body of two patches in space, held and loaded; `body`: "body: pair, " where it is one of several.
std::string loadedPair(const std::string& body) {
  std::string text = R"(
supports: [{@patch: left, face: left, fix: [x, y, z]}]
loads:
  - {@patch: right, body_force: [0, 0, -0.1]}
  - {@patch: right, face: right, traction: [0, 2, 0]}
  - {@patch: left, face: front, pressure: 0.5}
tools:
  - {name: ball, shape: sphere, center: [1.5, 0.5, 1.5], radius: 0.5, motion: {times: [0, 1], z: [0, -0.12]}}
contact: [{tool: ball, @patch: right, face: front}]
measures:
  - {name: end, kind: face, @patch: right, face: right}
  - {name: spot, kind: point, @patch: right, parameters: [0.5, 0.5, 0], fields: [displacement, pressure]}
solver: {tolerance: 1e-11}
steps: [{until: 1, count: 4}]
)";
  for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, body);
  return text;
}

TEST(Bodies, InSpacePatchesAreThoseOfTheNamedBody) {
  const std::string pair = R"(geometry: {shape: patches, patches: [
  {name: left, shape: box, size: [1, 1, 1], spans: [1, 2, 2]},
  {name: right, shape: box, origin: [1, 0, 0], size: [1, 1, 1], spans: [2, 2, 2]}]}
material: {law: neo-hookean, E: 200, nu: 0.3})";
  std::string indented = "  " + pair;
  for (std::size_t at = 0; (at = indented.find('\n', at)) != std::string::npos; ++at)
    indented.insert(at + 1, "    ");
  const std::string block = R"(bodies:
  - name: block
    degree: 1
    geometry: {shape: box, origin: [0, 3, 0], size: [1, 1, 1], spans: [2, 1, 1]}
    material: {law: neo-hookean, E: 10, nu: 0.2}
  - name: pair
  )";
  Scene both = parseScene(block + indented + "\n" + loadedPair("body: pair, "), "both.yaml");
  both.supports.push_back(both.supports.front());
  both.supports.back().place = {"block", "", "left"};
  const Outcome together = test::run(both, "pair_and_block");
  const Outcome alone = test::run(parseScene(pair + "\n" + loadedPair(""), "alone.yaml"), "pair_alone");
  ASSERT_TRUE(alone.summary.completed);
  EXPECT_GT(alone.history.column("ball.fz").back(), 0.1);
  for (const char* column : {"end.ux", "end.uy", "end.uz", "end.fy", "spot.uz", "spot.pressure", "ball.fz",
                             "strain_energy", "external_work"})
    EXPECT_NEAR(together.history.column(column).back(), alone.history.column(column).back(),
                1e-8 * std::abs(alone.history.column(column).back()) + 1e-13)
        << column;
  EXPECT_EQ(together.lastFrame.contact.at(0).patch, 2);
}

TEST(Bodies, AListOfOneGivesTheBitsOfASceneWithoutAList) {
  const Outcome one = test::run(firmAlone(), "firm_alone");
  Scene listed = firmAlone();
  listed.bodies = {listed.body};
  listed.bodies.front().name = "firm";
  const Outcome other = test::run(listed, "firm_listed");
  EXPECT_EQ(one.history.columns, other.history.columns);
  EXPECT_EQ(one.history.values, other.history.values);
  EXPECT_TRUE(one.lastFrame.fields.at("stress").values == other.lastFrame.fields.at("stress").values);
}

/// What a changed sample says.
std::string refusal(const std::string& found, const std::string& instead) {
  std::string text = samples::twoBodies;
  const std::size_t at = text.find(found);
  if (at == std::string::npos) return "the sample has no " + found;
  text.replace(at, found.size(), instead);
  try {
    reportOf(parseScene(text, "both.yaml"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Bodies, ABodyThatNothingHoldsIsNamed) {
  EXPECT_EQ(refusal("  - {body: firm, face: bottom, fix: [x, y]}\n", ""),
            "both.yaml:17:3: supports: body 'firm': nothing holds it in x, y, a turn; hold more of its "
            "components or faces, or let stabilise hold it until contact does");
  EXPECT_THAT(refusal("{body: firm, face: bottom, fix: [x, y]}", "{body: firm, face: bottom, fix: [y]}"),
              HasSubstr("body 'firm': nothing holds it in x; hold more"));
  EXPECT_THAT(refusal("{body: firm, face: bottom, fix: [x, y]}",
                      "{body: firm, face: bottom, part: [0, 0], fix: [x, y]}"),
              HasSubstr("body 'firm': nothing holds it in a turn; hold more"));
}

TEST(Bodies, MistakesInGeometryNameTheBody) {
  EXPECT_THAT(refusal("geometry: {shape: rectangle, origin: [1.5, 0], size: [0.5, 1], spans: [2, 3]}",
                      "geometry: {shape: control-net, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], "
                      "points: [[3, 0], [2, 0], [3, 1], [2, 1]]}"),
              HasSubstr("bodies[1].geometry: the body is inside out"));
  EXPECT_THAT(refusal("nu: 0.2}", "nu: 0.4999}"), "");
}

TEST(Bodies, WarningsNameTheBody) {
  std::string text = samples::twoBodies;
  text.replace(text.find("nu: 0.2}"), 8, "nu: 0.49999}");
  const SceneReport report = reportOf(parseScene(text, "both.yaml"));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("bodies[1].material.nu: 0.49999 is nearly incompressible"));
  EXPECT_THAT(report.summary,
              HasSubstr("body soft: NURBS of degree 2, body firm: Lagrange elements of degree 3"));
}

TEST(Bodies, ScalesAreThoseOfEachBody) {
  const auto model = buildModel<2>(parseScene(samples::twoBodies, "both.yaml"));
  ASSERT_EQ(model->contacts().size(), 2u);
  EXPECT_DOUBLE_EQ(model->contacts()[0].term->parameter(),
                   buildModel<2>(softAlone())->contacts()[0].term->parameter());
  EXPECT_DOUBLE_EQ(model->contacts()[1].term->parameter(),
                   buildModel<2>(firmAlone())->contacts()[0].term->parameter());
  EXPECT_DOUBLE_EQ(model->forceFloor(), kForceFloor * 100.0);
  EXPECT_DOUBLE_EQ(model->forceFloorOf(model->bodies()[1]), kForceFloor * 300.0);
}

TEST(Bodies, ADragHoldsEachByItsOwnStiffness) {
  const auto dragged = [](Scene scene) {
    for (SupportSpec& support : scene.supports) support.fix = {"y"};
    scene.stabilise.emplace();
    return scene;
  };
  const Outcome both = test::run(dragged(parseScene(samples::twoBodies, "both.yaml")), "two_dragged");
  const Outcome firm = test::run(dragged(firmAlone()), "firm_dragged");
  const Outcome soft = test::run(dragged(softAlone()), "soft_dragged");
  ASSERT_TRUE(both.summary.completed);
  EXPECT_GT(both.summary.stabilisationWork.value(), 0.0);
  EXPECT_NEAR(both.summary.stabilisationWork.value(),
              soft.summary.stabilisationWork.value() + firm.summary.stabilisationWork.value(),
              1e-7 * both.summary.stabilisationWork.value());
  EXPECT_NEAR(both.history.column("corner.ux").back(), firm.history.column("corner.ux").back(), 1e-10);
}

}  // namespace
}  // namespace burnish
