#include "postproc/study/measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "postproc/study/claims.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/study/evidence/refinement.h"
#include "tests/postproc/sample_records.h"
#include "tests/postproc/study/study_samples.h"

namespace burnish {
namespace {

using namespace samples;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Optional;

HistoryMeasure reduced(Reduction reduce, std::optional<std::array<double, 2>> range = {}) {
  HistoryMeasure measure;
  measure.y = "value";
  measure.range = range;
  measure.reduce = reduce;
  return measure;
}

DifferenceMeasure toCompare(std::optional<double> tolerance = {}, const std::string& other = {}) {
  DifferenceMeasure measure;
  measure.other = other;
  measure.y = "value";
  measure.tolerance = tolerance;
  return measure;
}

TEST(HistoryMeasure, ReducesTheRangeOnly) {
  const HistoryTable table = historyOf([](double t) { return (t - 1.0) * (t - 1.0); }, 2.0);
  const std::array<double, 2> range{0.5, 1.2};
  const auto value = [&](Reduction reduce) { return reduceHistory(table, reduced(reduce, range), {}).value; };
  EXPECT_THAT(value(Reduction::First), Optional(DoubleNear(0.25, 1e-12)));
  EXPECT_THAT(value(Reduction::Last), Optional(DoubleNear(0.04, 1e-12)));
  EXPECT_THAT(value(Reduction::Max), Optional(DoubleNear(0.25, 1e-12)));
  EXPECT_THAT(value(Reduction::Min), Optional(DoubleNear(0.0, 1e-12)));
}

TEST(HistoryMeasure, MeanIsOverXAndNotOverRows) {
  const HistoryTable uneven{
      "history.csv", {"time", "value"}, {{0.0, 0.01, 0.02, 0.03, 1.0}, {2, 2, 2, 2, 4}}};
  const double exact = 0.03 * 2.0 + 0.97 * 3.0;
  EXPECT_THAT(reduceHistory(uneven, reduced(Reduction::Mean), {}).value, Optional(DoubleNear(exact, 1e-12)));
}

TEST(HistoryMeasure, InterpolatesAtAPoint) {
  const HistoryTable table = historyOf([](double t) { return 3.0 * t; }, 2.0);
  HistoryMeasure measure = reduced(Reduction::At);
  measure.at = 1.234;
  EXPECT_THAT(reduceHistory(table, measure, {}).value, Optional(DoubleNear(3.702, 1e-12)));
  measure.at = 2.5;
  EXPECT_EQ(reduceHistory(table, measure, {}).value, std::nullopt);
}

TEST(HistoryMeasure, OscillationIsWhatAQuarticLeaves) {
  constexpr double kAmplitude = 0.02, kWaves = 40.0;
  HistoryTable table{"history.csv", {"time", "value"}, {{}, {}}};
  for (int k = 0; k < 4000; ++k) {
    const double t = 1.0 + k / 4000.0;
    table.values[0].push_back(t);
    table.values[1].push_back(7.0 - 3.0 * t + t * t * t - 2.0 * std::pow(t, 4) +
                              kAmplitude * std::sin(2.0 * std::numbers::pi * kWaves * t));
  }
  const auto value = reduceHistory(table, reduced(Reduction::Oscillation), {}).value;
  EXPECT_THAT(value, Optional(DoubleNear(kAmplitude / std::sqrt(2.0), 1e-4)));
}

TEST(HistoryMeasure, AQuinticIsNoQuartic) {
  const HistoryTable quartic = historyOf([](double t) { return std::pow(t, 4); }, 2.0);
  const HistoryTable quintic = historyOf([](double t) { return std::pow(t, 5); }, 2.0);
  EXPECT_LT(*reduceHistory(quartic, reduced(Reduction::Oscillation), {}).value, 1e-12);
  EXPECT_GT(*reduceHistory(quintic, reduced(Reduction::Oscillation), {}).value, 1e-3);
}

TEST(HistoryMeasure, ARunThatStoppedGivesNoNumberOverAShorterRange) {
  const HistoryTable table = historyOf([](double t) { return t; }, 1.4);
  for (const Reduction reduce : {Reduction::Max, Reduction::Mean, Reduction::Last, Reduction::Oscillation}) {
    const Measured beyond = reduceHistory(table, reduced(reduce, std::array{1.0, 2.0}), 1.4);
    EXPECT_EQ(beyond.value, std::nullopt);
    EXPECT_EQ(beyond.note, "stopped at t = 1.4");
    EXPECT_EQ(reduceHistory(table, reduced(reduce), 1.4).value, std::nullopt);
    EXPECT_TRUE(reduceHistory(table, reduced(reduce, std::array{0.0, 1.4}), 1.4).comparable());
  }
}

TEST(HistoryMeasure, LeavesRowsOut) {
  const HistoryTable table = historyOf([](double t) { return t; }, 2.0);
  HistoryMeasure measure = reduced(Reduction::Min);
  measure.where = "time >= 1.25";
  EXPECT_THAT(reduceHistory(table, measure, {}).value, Optional(DoubleNear(1.3, 1e-12)));
}

TEST(DifferenceMeasure, IsAPartOfTheOthersLargestValue) {
  const HistoryTable base = historyOf([](double t) { return 2.0 - t; }, 2.0);
  const HistoryTable bent = historyOf([](double t) { return 2.0 - t + 0.1 * std::max(0.0, t - 1.0); }, 2.0);
  const Measured measured = compareHistories(bent, {}, base, {}, toCompare());
  EXPECT_THAT(measured.value, Optional(DoubleNear(0.05, 1e-12)));
}

TEST(DifferenceMeasure, FindsWhereCurvesPart) {
  const HistoryTable base = historyOf([](double t) { return 2.0 - t; }, 2.0);
  const HistoryTable bent = historyOf([](double t) { return 2.0 - t + 0.1 * std::max(0.0, t - 1.0); }, 2.0);
  DifferenceMeasure measure = toCompare(0.0375);  // 0.075 = 0.1 (t - 1) at t = 1.75
  EXPECT_THAT(compareHistories(bent, {}, base, {}, measure).value, Optional(DoubleNear(1.75, 1e-9)));
  measure.tolerance = 0.06;
  EXPECT_EQ(compareHistories(bent, {}, base, {}, measure).value, std::nullopt);
}

TEST(DifferenceMeasure, APartingBeforeTheStopCounts) {
  const HistoryTable base = historyOf([](double t) { return 2.0 - t; }, 2.0);
  const HistoryTable bent = historyOf([](double t) { return 2.0 - t + 0.1 * std::max(0.0, t - 1.0); }, 1.5);
  DifferenceMeasure measure = toCompare(0.02);
  EXPECT_THAT(compareHistories(bent, 1.5, base, {}, measure).value, Optional(DoubleNear(1.4, 1e-9)));
  measure.tolerance.reset();
  EXPECT_EQ(compareHistories(bent, 1.5, base, {}, measure).note, "stopped at t = 1.5");
  EXPECT_THAT(compareHistories(base, {}, bent, 1.5, measure).note, HasSubstr("stopped at t = 1.5"));
}

TEST(LineMeasure, VariationOfALinearFieldIsItsChange) {
  Sample sample = slab();
  const PatchRecord& patch = sample.model.mesh.patches.front();
  FieldRecord linear{{}, "", Eigen::MatrixXd::Zero(1, sample.model.mesh.numNodes)};
  for (std::size_t a = 0; a < patch.nodes.size(); ++a)
    linear.values(0, patch.nodes[a]) = -5.0 * patch.points(0, static_cast<Eigen::Index>(a));
  sample.frame.fields["linear"] = linear;
  EXPECT_NEAR(reduceLine(sample.model, sample.frame, {.field = "linear"}), 15.0, 1e-12);
  EXPECT_NEAR(reduceLine(sample.model, sample.frame, {.field = "linear", .reduce = LineReduction::Min}),
              -15.0, 1e-12);
}

TEST(LineMeasure, SeesWhatHappensWithinASpan) {
  Sample sample = slab();
  const MeshRecord& mesh = sample.model.mesh;
  FieldRecord bump{{}, "", Eigen::MatrixXd::Zero(1, mesh.numNodes)};
  bump.values(0, mesh.patches.front().nodes[5]) = 1.0;  // one quadratic B-spline: up to 3/4 and down
  sample.frame.fields["bump"] = bump;
  EXPECT_NEAR(reduceLine(sample.model, sample.frame, {.field = "bump", .height = 0.0}), 1.5, 1e-12);
}

TEST(LineMeasure, GoesOnOverAChangeOfTheMesh) {
  const Sample anew = meshedAnew(slab(), slab({7, 4}));
  const LineMeasure measure{.field = "plastic_strain", .height = 0.5, .reduce = LineReduction::Max};
  EXPECT_NEAR(reduceLine(anew.model, anew.frame, measure), 0.25, 1e-3);  // at points near the middle
}

TEST(LineMeasure, HeightIsAPartOfTheSecondParameter) {
  const Sample sample = slab();  // 4 s (1-s) t²: up and down along the line
  const LineMeasure measure{.field = "plastic_strain", .height = 0.5};
  EXPECT_NEAR(reduceLine(sample.model, sample.frame, measure), 2.0 * 0.25, 1e-9);
  EXPECT_THROW(reduceLine(cube().model, cube().frame, {.field = "pressure"}), Error);
}

TEST(ConvergenceOrder, OfAQuadraticSequenceIsTwo) {
  EXPECT_THAT(convergenceOrder({1e-1, 1e-2, 1e-4, 1e-8, 1e-16}), Optional(DoubleNear(2.0, 1e-9)));
  EXPECT_THAT(convergenceOrder({1.0, 1e-1, 1e-2, 1e-3}), Optional(DoubleNear(1.0, 1e-9)));
  EXPECT_EQ(convergenceOrder({1e-3, 1e-13}), std::nullopt);
}

TEST(ConvergenceOrder, IsTheMedianOverTheSteps) {
  HistoryTable table{"convergence.csv", {"step", "residual"}, {{}, {}}};
  const auto step = [&](double number, const std::vector<double>& residuals) {
    for (const double r : residuals) {
      table.values[0].push_back(number);
      table.values[1].push_back(r);
    }
  };
  step(1, {1e-1, 1e-2, 1e-4});
  step(2, {1e-1, 1e-2, 1e-3});
  step(3, {1e-5, 1e-10});  // too short to tell
  step(4, {1e-1, 1e-2, 1e-4, 1e-8});
  EXPECT_THAT(convergenceOverSteps(table).value, Optional(DoubleNear(2.0, 1e-9)));
}

TEST(Refinement, FindsTheLimitOfAnyOrder) {
  for (const double order : {0.9, 1.0, 2.0, 3.5}) {
    const auto mesh = [&](double h) { return MeshValue{h, 5.0 - 0.3 * std::pow(h, order)}; };
    const std::array meshes{mesh(0.3), mesh(0.16), mesh(0.1)};  // no common ratio of the sizes
    EXPECT_THAT(extrapolatedLimit(meshes), Optional(DoubleNear(5.0, 1e-9)));
    EXPECT_THAT(observedOrder(meshes[1], meshes[2], 5.0), Optional(DoubleNear(order, 1e-6)));
    EXPECT_THAT(meanOrder({meshes[0], meshes[1], meshes[2]}, 5.0), Optional(DoubleNear(order, 1e-6)));
  }
}

TEST(Refinement, HasNoLimitWhereValuesDoNotSettle) {
  EXPECT_EQ(extrapolatedLimit({MeshValue{4, 1.0}, MeshValue{2, 1.1}, MeshValue{1, 1.3}}), std::nullopt);
  EXPECT_EQ(extrapolatedLimit({MeshValue{4, 1.0}, MeshValue{2, 1.1}, MeshValue{1, 1.05}}), std::nullopt);
  EXPECT_EQ(extrapolatedLimit({MeshValue{4, 0.69}, MeshValue{2, 0.39}, MeshValue{1, 0.19}}), std::nullopt);
}

TEST(EvaluateMeasure, ReadsTheResultsOfARun) {
  const ScratchDirectory directory;
  const Study study = madeUpStudy(directory.path());
  const auto value = [&](std::size_t run, const MeasureSpec& measure) {
    return evaluateMeasure(study, study.runs[run], measure, directory.path());
  };
  EXPECT_THAT(value(0, {"v", "V", reduced(Reduction::Last)}).value, Optional(DoubleNear(1.25, 1e-12)));
  EXPECT_THAT(value(0, {"n", "N", SummaryMeasure{"iterations"}}).value, Optional(60.0));
  EXPECT_THAT(value(0, {"l", "L", LineMeasure{.field = "plastic_strain", .time = 1.0}}).value,
              Optional(DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(value(0, {"c", "C", ConvergenceMeasure{}}).value, Optional(DoubleNear(2.0, 1e-9)));
  const DifferenceMeasure toFine = toCompare({}, "{basis}-fine");
  EXPECT_THAT(value(0, {"d", "D", toFine}).value, Optional(DoubleNear(1.25 / (1 + 4.0 / 256) - 1, 1e-9)));
  EXPECT_THROW(value(0, {"n", "N", SummaryMeasure{"iteratons"}}), Error);
  EXPECT_THROW(value(0, {"l", "L", LineMeasure{.field = "plastic_strain", .time = 0.7}}), Error);
}

TEST(EvaluateMeasure, ReadsDepthsProfilesAndRoughness) {
  const ScratchDirectory directory;
  const Study study = madeUpStudy(directory.path());
  SeenProfiles seen;
  const auto value = [&](std::size_t run, const Quantity& quantity) {
    return evaluateMeasure(study, study.runs[run], {"m", "M", quantity}, directory.path(), seen);
  };
  ProbeSpec place;
  place.depth = "top@1.5,1";
  // In the middle the strain is t² at the time 1, and the slab pressed to 0.85.
  EXPECT_THAT(value(0, DepthMeasure{place, "hardened_depth", 1.0}).value,
              Optional(DoubleNear(0.85 * (1.0 - std::sqrt(0.002)), 1e-3)));
  EXPECT_EQ(value(0, DepthMeasure{place, "force", 1.0}).note, "the body has none");
  EXPECT_THAT(value(0, DepthMeasure{place, "depth", {}}).value, Optional(DoubleNear(0.85, 1e-8)));
  ProbeSpec softer = place;
  softer.hardenedBelow = 0.5;
  EXPECT_THAT(value(0, DepthMeasure{softer, "hardened_depth", 1.0}).value,
              Optional(DoubleNear(0.85 * (1.0 - std::sqrt(0.5)), 1e-3)));

  RoughnessMeasure roughness;
  roughness.face.face = "top";
  roughness.number = RoughnessMeasure::Number::Z;
  EXPECT_THAT(value(0, roughness).value, Optional(DoubleNear(0.15, 1e-9)));

  const Sample sample = slab();
  const std::filesystem::path other = runDirectory(directory.path(), study.runs[1]);
  const RunAccount account = readSummary(other);
  ResultWriter result(other, sample.model);
  FrameRecord frame = sample.frame;
  frame.fields["plastic_strain"].values *= 1.25;
  Eigen::MatrixXd uniform = Eigen::MatrixXd::Zero(4, sample.model.mesh.numNodes);
  uniform.row(0).setConstant(7.0);
  frame.fields["stress"] = {{"xx", "yy", "xy", "zz"}, "MPa", uniform};
  result.append(frame);
  writeSummary(other, account);
  const SectionMeasure section{{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {}, "force", {}};
  EXPECT_THAT(value(1, section).value,
              Optional(DoubleNear(7.0 * value(1, SectionMeasure{section.plane, {}, "area", {}}).value.value(),
                                  1e-9)));
  place.fields = {"plastic_strain"};
  EXPECT_THAT(value(0, ProfileMeasure{place, study.runs[1].name, {}, {}}).value,
              Optional(DoubleNear((2.0 - 1.25) / 1.25, 1e-6)));
  // Of the lower half, where strains are a quarter and less, as a part of the whole profile's peak.
  const std::array<double, 2> lowerHalf{0.425, 0.85};
  EXPECT_THAT(value(0, ProfileMeasure{place, study.runs[1].name, lowerHalf, {}}).value,
              Optional(DoubleNear(0.25 * (2.0 - 1.25) / 1.25, 1e-6)));
  EXPECT_EQ(value(0, ProfileMeasure{place, study.runs[1].name, std::array{1.0, 2.0}, {}}).note,
            "no common depth");
  // X-rays that penetrate far see means of all that lies deeper, of either run.
  ProbeSpec byRays = place;
  byRays.penetration = 0.1;
  EXPECT_THAT(value(0, ProfileMeasure{byRays, study.runs[1].name, {}, {}}).value,
              Optional(DoubleNear((2.0 - 1.25) / 1.25, 1e-6)));
}

TEST(EvaluateMeasure, MarksWhatARunThatStoppedCannotShow) {
  const ScratchDirectory directory;
  const Study study = madeUpStudy(directory.path());
  const StudyRun& stopped = study.runs[3];
  const Measured iterations =
      evaluateMeasure(study, stopped, {"n", "N", SummaryMeasure{"iterations"}}, directory.path());
  EXPECT_THAT(iterations.value, Optional(42.0));
  EXPECT_EQ(iterations.comparable(), std::nullopt);
  const MeasureSpec line{"l", "L", LineMeasure{.field = "plastic_strain", .time = 2.0}};
  EXPECT_EQ(evaluateMeasure(study, stopped, line, directory.path()).note, "stopped at t = 1.4");
  const MeasureSpec end{"e", "E", SummaryMeasure{"end_time"}};
  EXPECT_THAT(evaluateMeasure(study, stopped, end, directory.path()).comparable(), Optional(1.4));
}

TEST(Claims, ShowTheNumbersThatDecide) {
  const ScratchDirectory directory;
  const Study study = madeUpStudy(directory.path());
  StatementSpec statement{
      .name = "s", .title = "S", .text = {}, .runs = {}, .measures = {}, .claims = {}, .figures = {}};
  statement.measures = {{"last", "last value", reduced(Reduction::Last)}};
  const ParameterSpec basis{"basis", {"nurbs", "lagrange"}, {"NURBS", "Lagrange"}};
  statement.claims = {{.text = "{basis.label} from above",
                       .measure = "last",
                       .vary = {basis},
                       .runs = {"{basis}-fine", "nurbs-middle"},
                       .expect = ClaimSpec::Expect::Increasing,
                       .within = {},
                       .range = {}}};
  SeenProfiles seen;
  std::vector<std::string> faults;
  const auto judged = judgeClaims(study, statement, directory.path(), seen, faults);
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged[0].verdict, Verdict::Holds);
  EXPECT_EQ(judged[0].text, "NURBS from above");
  EXPECT_EQ(judged[0].numbers, "last value — NURBS, fine: 1.016; NURBS, middle: 1.062");
  EXPECT_EQ(judged[1].verdict, Verdict::CannotBeTold);
  EXPECT_THAT(judged[1].numbers, HasSubstr("Lagrange, fine: —, stopped at t = 1.4"));

  ClaimSpec& claim = statement.claims.front();
  claim.text = "they differ";
  claim.vary = {};
  claim.runs = {"nurbs-fine", "nurbs-middle"};
  const auto verdictOf = [&] {
    return judgeClaims(study, statement, directory.path(), seen, faults).front().verdict;
  };
  claim.expect = ClaimSpec::Expect::Different;
  claim.within = 0.04;
  EXPECT_EQ(verdictOf(), Verdict::Holds);
  claim.within = 0.05;
  EXPECT_EQ(verdictOf(), Verdict::DoesNotHold);
  claim.expect = ClaimSpec::Expect::Between;
  claim.range = {1.0, 1.05};
  EXPECT_EQ(verdictOf(), Verdict::DoesNotHold);
  claim.range = {1.0, 1.07};
  EXPECT_EQ(verdictOf(), Verdict::Holds);
}

}  // namespace
}  // namespace burnish
