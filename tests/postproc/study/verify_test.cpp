#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "postproc/study/evidence/quantity.h"
#include "postproc/study/verification/check_table.h"
#include "postproc/study/verification/judgement.h"
#include "postproc/study/verification/verification_document.h"
#include "postproc/text/text_file.h"
#include "tests/postproc/study/study_samples.h"

/// Checks of scenes, held against histories that are made up.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::ScratchDirectory;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kBlock = R"(# A block.
#
# Second paragraph.
title: Block
degree: 1
definitions: [{name: half, formula: 1/2}, {name: ramp, formula: half*t}, {name: a, formula: X}]
geometry: {shape: rectangle, size: [2, 1], spans: [2, 1]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
steps: [{until: 2, count: 4}]
)";
const std::string kThreeMeshes = R"(variants:
  families: [{name: "p = 1"}, {name: "p = 2", set: [degree=2]}]
  meshes: [{size: 1}, {size: 0.5, set: ["geometry.spans=[4, 2]"]}, {size: 0.25, set: ["geometry.spans=[8, 4]"]}]
)";

/// Times 0, 1 and 2, and a column `value`.
HistoryTable history(const std::vector<double>& values) {
  return {.path = "history.csv", .columns = {"time", "value"}, .values = {{0.0, 1.0, 2.0}, values}};
}

class Verify : public testing::Test {
 protected:
  VerificationCase caseOf(const std::string& yaml) const {
    writeText(yaml, scratch_.path() / "block.yaml");
    return readCase(scratch_.path() / "block.yaml");
  }

  /// The message about a scene.
  std::string errorOf(const std::string& yaml) const {
    try {
      caseOf(yaml);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  static std::string checks(const std::string& check) { return "checks: [{name: A, " + check + "}]\n"; }

  /// The rows of the only check of a scene with three meshes, for last values by family and mesh.
  std::vector<CheckRow> rowsOf(const std::string& check,
                               const std::vector<std::vector<double>>& values) const {
    const VerificationCase verified = caseOf(kBlock + kThreeMeshes + checks("quantity: value, " + check));
    CaseOutcomes outcomes;
    for (const auto& family : values) {
      outcomes.emplace_back();
      for (const double value : family) outcomes.back().push_back({history({0.0, 0.0, value}), {}});
    }
    return judgeChecks(verified, outcomes).front().rows;
  }

  std::vector<bool> verdicts(const std::string& check, const std::vector<std::vector<double>>& values) const {
    std::vector<bool> verdicts;
    for (const CheckRow& row : rowsOf(check, values)) verdicts.push_back(row.holds());
    return verdicts;
  }

  ScratchDirectory scratch_;
};

TEST_F(Verify, RunsEveryFamilyOnEveryMesh) {
  const VerificationCase verified =
      caseOf(kBlock + kThreeMeshes + checks("quantity: time, expect: monotone"));
  EXPECT_EQ(verified.explanation, "A block.\n\nSecond paragraph.\n");
  std::vector<std::string> names;
  for (const StudyRun& run : studyOf({verified}).runs) names.push_back(run.name);
  EXPECT_THAT(names, ElementsAre("block/p-1/mesh-1", "block/p-1/mesh-2", "block/p-1/mesh-3",
                                 "block/p-2/mesh-1", "block/p-2/mesh-2", "block/p-2/mesh-3"));
  EXPECT_THAT(verified.families[1].variants[2].run.overrides,
              ElementsAre("degree=2", "geometry.spans=[8, 4]", "pictures=[]", "output.vtu=false", "checks=[]",
                          "charts=[]", "variants=null"));
  EXPECT_EQ(verified.families[1].variants[2].size, 0.25);
  EXPECT_THROW(studyOf({verified, verified}), Error);
}

TEST_F(Verify, AWrongVariantIsNamed) {
  const std::string wrong = "variants: {families: [{name: odd, set: [degre=2]}]}\n";
  EXPECT_THAT(errorOf(kBlock + wrong + checks("quantity: time, expect: range, at_least: 0")),
              testing::AllOf(HasSubstr("variant block/odd: "), HasSubstr("Did you mean \"degree\"?")));
  EXPECT_THAT(errorOf(kBlock), HasSubstr("found no checks"));
}

TEST_F(Verify, MistakesInChecksAreFoundBeforeAnythingRuns) {
  const auto problem = [&](const std::string& check) {
    return errorOf(kBlock + kThreeMeshes + checks(check));
  };
  const std::string value = "quantity: value, expect: value, value: ";
  EXPECT_THAT(problem(value + "1"), HasSubstr("checks[0]: found none of relative and absolute"));
  EXPECT_THAT(problem(value + "1, relative: 1, absolute: 1"), HasSubstr("found both relative and absolute"));
  EXPECT_THAT(problem(value + "0, relative: 1"), HasSubstr("relative to the value 0"));
  EXPECT_THAT(problem(value + "ramp, absolute: 1"),
              HasSubstr("checks[0].value: found \"ramp\", which depends on t"));
  EXPECT_THAT(problem(value + "hald, absolute: 1"), HasSubstr("hald"));
  EXPECT_THAT(problem(value + "1, absolute: 1, families: [p = 3]"), HasSubstr("Did you mean \"p = 1\"?"));
  EXPECT_THAT(problem(value + "1, absolute: 1, time: 2.5"), HasSubstr("checks[0].time: found 2.5; allowed"));
  EXPECT_THAT(problem("quantity: tip.ux, expect: monotone"),
              HasSubstr("no tool or measure has the name tip"));
  EXPECT_THAT(problem("quantity: 1 +, expect: monotone"), HasSubstr("cannot be understood"));
  EXPECT_THAT(problem("quantity: value, expect: range"), HasSubstr("found no bound"));
  EXPECT_THAT(problem("quantity: value, expect: range, at_least: 1, at_most: half"),
              HasSubstr("checks[0].at_most"));
  EXPECT_THAT(errorOf(kBlock + checks("quantity: value, expect: order, order: 2")),
              HasSubstr("found order with one mesh"));
  EXPECT_THAT(errorOf(kBlock + checks("quantity: value, expect: same")), HasSubstr("two families or more"));
  EXPECT_THAT(errorOf(kBlock + "variants: {meshes: [{size: 1}, {size: 1}]}\n" +
                      checks("quantity: value, expect: monotone")),
              HasSubstr("variants.meshes[1].size: found 1 after 1"));
}

TEST_F(Verify, ChecksReadTheColumnsOfPairsAndBodies) {
  const std::string bodies = R"(degree: 1
bodies:
  - {name: low, geometry: {shape: rectangle, size: [2, 1], spans: [2, 1]}, material: {law: neo-hookean, E: 1, nu: 0.3}}
  - {name: high, geometry: {shape: rectangle, origin: [0, 1], size: [2, 1], spans: [2, 1]}, material: {law: neo-hookean, E: 1, nu: 0.3}}
supports: [{body: low, face: bottom, fix: [x, y]}, {body: high, face: top, fix: [x, y]}]
contact: [{name: joint, body: high, face: bottom, against: {body: low, face: top}}]
steps: [{until: 1, count: 1}]
)";
  EXPECT_EQ(errorOf(bodies + checks("quantity: joint.fy/low.strain_energy, expect: range, at_least: 0")), "");
  EXPECT_THAT(errorOf(bodies + checks("quantity: joins.fy/2, expect: range, at_least: 0")),
              HasSubstr("Did you mean \"joint\"?"));
}

TEST_F(Verify, AQuantityIsARowOrAnExtremeOfAFormula) {
  const VerificationCase verified = caseOf(kBlock + checks("quantity: time, expect: range, at_least: 0"));
  const HistoryTable table = history({3.0, 7.0, 5.0});
  const auto& definitions = verified.document.scene.definitions;
  CheckedQuantity quantity;
  quantity.formula = "value";
  EXPECT_EQ(valueOf(quantity, table, definitions), 5.0);
  quantity.reduction = RowReduction::Max;
  EXPECT_EQ(valueOf(quantity, table, definitions), 7.0);
  quantity.reduction = RowReduction::Min;
  EXPECT_EQ(valueOf(quantity, table, definitions), 3.0);
  quantity.formula = "value - ramp";  // 3, 6.5, 4
  quantity.time = 1.0 + 1e-12;
  EXPECT_EQ(valueOf(quantity, table, definitions), 6.5);
}

TEST_F(Verify, AQuantityThatCannotBeHadIsAnError) {
  const VerificationCase verified = caseOf(kBlock + checks("quantity: time, expect: range, at_least: 0"));
  const auto message = [&](const CheckedQuantity& quantity) -> std::string {
    try {
      valueOf(quantity, history({3.0, 7.0, 5.0}), verified.document.scene.definitions);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CheckedQuantity quantity;
  quantity.formula = "valu";
  EXPECT_THAT(message(quantity), HasSubstr("Did you mean \"value\"?"));
  quantity.formula = "value/time";
  quantity.reduction = RowReduction::Max;
  EXPECT_EQ(message(quantity), "the quantity is not finite at t = 0");
  quantity.formula = "value - a";
  EXPECT_THAT(message(quantity), HasSubstr("the definition a depends on X"));
  quantity.formula = "value";
  quantity.time = 0.8;
  EXPECT_EQ(message(quantity), "there is no row at t = 0.8; the nearest one is at t = 1");
}

TEST_F(Verify, AValueHoldsWithinItsTolerance) {
  const std::vector<std::vector<double>> values{{9.0, 0.6, 0.505}, {9.0, 0.6, 0.494}};
  EXPECT_THAT(verdicts("expect: value, value: half, relative: 0.011", values), ElementsAre(true, false));
  EXPECT_THAT(verdicts("expect: value, value: half, absolute: 0.0055", values), ElementsAre(true, false));
  EXPECT_THAT(verdicts("expect: value, value: half, absolute: 0.2, meshes: every", values),
              ElementsAre(false, false));
  EXPECT_THAT(verdicts("expect: value, value: half, relative: 0.011, families: [p = 1]", values),
              ElementsAre(true));
}

TEST_F(Verify, ARangeIncludesItsBounds) {
  const std::vector<std::vector<double>> values{{9.0, 0.6, 0.5}, {0.5, 0.7, 1.0}};
  EXPECT_THAT(verdicts("expect: range, at_least: half", values), ElementsAre(true, true));
  EXPECT_THAT(verdicts("expect: range, at_most: 0.9", values), ElementsAre(true, false));
  EXPECT_THAT(verdicts("expect: range, at_least: half, at_most: 1, meshes: every", values),
              ElementsAre(false, true));
}

TEST_F(Verify, AnOrderIsThatOfTheTwoFinestMeshesAboveTheFloor) {
  const auto rows = rowsOf("expect: order, order: 2, limit: half", {{1.5, 0.75, 0.5625}, {0.4, 0.48, 0.49}});
  EXPECT_THAT(rows[0].orders, ElementsAre(testing::Optional(2.0), testing::Optional(2.0)));
  EXPECT_THAT(rows[0].values, ElementsAre(1.0, 0.25, 0.0625));
  EXPECT_TRUE(rows[0].holds());
  EXPECT_NEAR(rows[1].orders[0].value(), std::log2(5.0), 1e-12);
  EXPECT_NEAR(rows[1].orders[1].value(), 1.0, 1e-12);
  EXPECT_FALSE(rows[1].holds());

  EXPECT_THAT(verdicts("expect: order, order: 2", {{1.0, 0.5, 0.125}, {1.0, 0.1, 0.05}}),
              ElementsAre(true, false));
  const std::vector<std::vector<double>> errors{{1.0, 0.25, 0.2}, {1.0, 0.3, 0.2}};
  EXPECT_THAT(verdicts("expect: order, order: 2, floor: 0.2", errors), ElementsAre(true, false));
  EXPECT_THAT(verdicts("expect: order, order: 2, tolerance: 0.3, floor: 0.2", errors),
              ElementsAre(true, true));
  EXPECT_THAT(rowsOf("expect: order, order: 2, floor: 0.9", errors)[0].problem,
              HasSubstr("fewer than two meshes have errors above 0.9"));
}

TEST_F(Verify, MonotoneMeansStrictlyFromMeshToMesh) {
  const std::vector<std::vector<double>> values{{1.0, 2.0, 3.0}, {3.0, 2.0, 2.0}};
  EXPECT_THAT(verdicts("expect: monotone", values), ElementsAre(true, false));
  EXPECT_THAT(verdicts("expect: monotone, direction: decreasing", values), ElementsAre(false, false));
}

TEST_F(Verify, SameComparesTheFinestMeshesOfAllFamilies) {
  const std::vector<std::vector<double>> values{{3.0, 2.0, -100.0}, {1.0, 2.0, -98.5}};
  EXPECT_THAT(verdicts("expect: same, relative: 0.016", values), ElementsAre(true, true));
  EXPECT_THAT(verdicts("expect: same, relative: 0.014", values), ElementsAre(false, false));
}

TEST_F(Verify, ARunThatHasNoValueFailsItsChecks) {
  const VerificationCase verified =
      caseOf(kBlock + kThreeMeshes +
             "checks:\n- {name: A, quantity: value, expect: value, value: 1, absolute: 1}\n"
             "- {name: B, quantity: value, expect: same}\n");
  const VariantOutcome fine{history({1.0, 1.0, 1.0}), {}};
  const auto judged = judgeChecks(verified, {{fine, fine, fine}, {fine, {{}, "the run failed"}, fine}});
  EXPECT_TRUE(judged[0].rows[0].holds());
  EXPECT_FALSE(judged[0].rows[1].holds());
  EXPECT_EQ(judged[0].rows[1].problem, "mesh 2: the run failed");
  EXPECT_FALSE(judged[1].rows[0].holds());
  EXPECT_EQ(numHolding(judged), 0u);
  EXPECT_THAT(problemsText(judged), HasSubstr("- A, p = 2: mesh 2: the run failed\n"));
}

// A check may hold although its run says that it is not to be trusted.
TEST_F(Verify, DoubtfulRunsAreNamedBesideTheChecks) {
  const VerificationCase verified =
      caseOf(kBlock + kThreeMeshes + checks("quantity: value, expect: value, value: 1, absolute: 1"));
  const VariantOutcome fine{history({1.0, 1.0, 1.0})};
  VariantOutcome doubtful = fine;
  doubtful.doubts = {{"a face penetrates", 0.5, 3}};
  const CaseOutcomes outcomes{{doubtful, fine, fine}, {fine, fine, doubtful}};
  const std::string line =
      "- doubtful (a face penetrates): p = 1, mesh 1 from t = 0.5; p = 2, mesh 3 from t = 0.5\n";
  EXPECT_EQ(doubtsText(verified, outcomes), line);
  EXPECT_EQ(doubtsText(verified, {{fine, fine, fine}, {fine, fine, fine}}), "");
  const fs::path file = scratch_.path() / "verification.md";
  writeVerification({{&verified, outcomes, judgeChecks(verified, outcomes)}}, file,
                    scratch_.path() / "images");
  EXPECT_THAT(readText(file), HasSubstr(line));
}

TEST_F(Verify, ToolsThatNeverTouchAreNamedBesideTheChecks) {
  const VerificationCase verified =
      caseOf(kBlock + kThreeMeshes + checks("quantity: value, expect: value, value: 1, absolute: 1"));
  const VariantOutcome fine{history({1.0, 1.0, 1.0})};
  VariantOutcome idle = fine;
  idle.idleTools = {"disc"};
  EXPECT_EQ(doubtsText(verified, {{idle, fine, fine}, {fine, idle, fine}}),
            "- tool 'disc' has never touched the body: p = 1, mesh 1; p = 2, mesh 2\n");
}

// Tables, problems and charts say of sizes what they are sizes of.
TEST_F(Verify, SizesOfStepsAreNamedAsSuch) {
  const VerificationCase verified =
      caseOf(kBlock +
             "variants: {sizes: steps, meshes: [{size: 0.5}, {size: 0.25, set: [\"steps[0].count=8\"]}]}\n" +
             checks("quantity: value, expect: value, value: 1, absolute: 1"));
  EXPECT_EQ(verified.sizes.title, "size Δt of the steps");
  EXPECT_EQ(caseOf(kBlock + kThreeMeshes + checks("quantity: value, expect: monotone")).sizes.title,
            "size h of the cells");
  const auto judged = judgeChecks(verified, {{{history({1.0, 1.0, 1.0})}, {{}, "the run failed"}}});
  EXPECT_EQ(judged[0].rows[0].problem, "Δt = 0.25: the run failed");
  EXPECT_THAT(checkTable(verified, judged),
              testing::AllOf(HasSubstr("| Δt = 0.5 |"), HasSubstr("| Δt = 0.25 |")));
}

TEST_F(Verify, TheDocumentShowsAllMeshesAndDrawsTheOrders) {
  const VerificationCase verified = caseOf(
      kBlock + kThreeMeshes +
      "checks:\n- {name: tip, quantity: value, expect: value, value: half, absolute: 0.1, source: Euler}\n"
      "- {name: error of the tip, quantity: value, expect: order, order: 2, limit: half}\n"
      "charts:\n- {x: time, y: value / 2, y_title: half of it}\n");
  CaseOutcomes outcomes;
  for (const double factor : {1.0, 3.0}) {
    outcomes.emplace_back();
    for (const double h : {1.0, 0.5, 0.25})
      outcomes.back().push_back({history({0, 0, 0.5 + factor * h * h}), {}});
  }
  const auto judged = judgeChecks(verified, outcomes);
  const fs::path file = scratch_.path() / "docs/verification.md";
  writeVerification({{&verified, outcomes, judged}}, file, scratch_.path() / "docs/images");
  const std::string text = readText(file);
  EXPECT_THAT(text, HasSubstr("-curve-1.png>)"));
  EXPECT_THAT(text, HasSubstr("1 of 2 checks hold."));
  EXPECT_THAT(text, HasSubstr("## Block\n\nA block.\n\nSecond paragraph.\n"));
  EXPECT_THAT(text, HasSubstr("| tip <sup>1</sup>"));
  EXPECT_THAT(text, HasSubstr("| p = 1  |   1.5 |    0.75 |   0.5625 |"));
  EXPECT_THAT(text, HasSubstr("| 2.00, 2.00 | order 2.00 |"));
  EXPECT_THAT(text, HasSubstr("<sup>1</sup> Euler\n"));
  EXPECT_THAT(text, HasSubstr("![](<images/block-1.png>)"));
  EXPECT_TRUE(fs::exists(scratch_.path() / "docs/images/block-1.png"));
}

}  // namespace
}  // namespace burnish
