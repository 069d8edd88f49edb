#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/result_writer.h"
#include "postproc/compare/annotations.h"
#include "postproc/compare/data/compare_data.h"
#include "postproc/compare/data/data_report.h"
#include "postproc/compare/data/worst_pictures.h"
#include "postproc/compare/junit.h"
#include "postproc/compare/picture.h"
#include "postproc/export/vtk_file.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/text/text_file.h"
#include "tests/message_of.h"
#include "tests/postproc/sample_records.h"

/// Differences that were made on purpose between data that are the same otherwise: each is found, alone, and
/// named.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using samples::Sample;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Field, verdict and message of what is not equal.
struct Finding {
  std::string name, verdict, message;
};

std::vector<Finding> findingsIn(const std::vector<ResultComparison>& comparisons) {
  std::vector<Finding> findings;
  for (const auto& [pair, fields] : comparisons)
    for (const FieldComparison& field : fields)
      if (field.verdict != FieldVerdict::Equal)
        findings.push_back({fullName(pair, field), verdictName(field.verdict), field.message});
  return findings;
}

/// One finding of this name, verdict and part of the message.
auto isOnly(const std::string& name, const std::string& verdict, const std::string& part) {
  return ElementsAre(testing::AllOf(testing::Field(&Finding::name, name),
                                    testing::Field(&Finding::verdict, verdict),
                                    testing::Field(&Finding::message, HasSubstr(part))));
}

std::vector<std::string> namesIn(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (const Finding& finding : findings) names.push_back(finding.name);
  return names;
}

class DataFiles : public testing::Test {
 protected:
  DataFiles() { fs::create_directories(dir_); }
  ~DataFiles() override { fs::remove_all(dir_); }

  const fs::path dir_ = fs::temp_directory_path() / ("burnish_compare_data_" + std::to_string(::getpid()));
};

Sample slabUnderADisc(Sample sample = samples::rubbedSlab()) {
  sample.model.tools[0].name = "disc";
  return sample;
}

/// A run with frames at these times, of a slab whose disc rubs it.
struct MadeRun {
  Sample sample = slabUnderADisc();
  std::vector<double> times{0.0, 0.5, 1.0};
  std::vector<std::string> columns{"step", "time", "disc.fy"};
  std::vector<std::vector<double>> rows{{0, 0, 0}, {1, 0.5, 2}, {2, 1, 4}};
  std::function<void(FrameRecord&)> spoil = [](FrameRecord&) {};  ///< of the last frame
};

class CompareResults : public DataFiles {
 protected:
  CompareResults() { write(MadeRun{}, "baseline"); }

  void write(const MadeRun& run, const std::string& name) const {
    ResultWriter writer(dir_ / name, run.sample.model);
    for (std::size_t k = 0; k < run.times.size(); ++k) {
      FrameRecord frame = run.sample.frame;
      frame.index = frame.step = static_cast<int>(k);
      frame.time = run.times[k];
      if (k + 1 == run.times.size()) run.spoil(frame);
      writer.append(frame);
    }
    HistoryWriter history(dir_ / name / "history.csv", run.columns);
    for (const std::vector<double>& row : run.rows) history.append(row);
  }

  std::vector<Finding> findings(const MadeRun& run, const DataRule& rule = {}) const {
    write(run, "actual");
    return findingsIn(compareData(ComparedKind::Result, dir_ / "actual", dir_ / "baseline", rule));
  }

  std::vector<Finding> findings(const std::function<void(FrameRecord&)>& spoil,
                                const DataRule& rule = {}) const {
    MadeRun run;
    run.spoil = spoil;
    return findings(run, rule);
  }
};

/// Pixels of these colours left of the scale.
std::pair<int, int> redAndBlueIn(const fs::path& png) {
  const Picture drawn = readPicture(png);
  int red = 0, blue = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width * 2 / 3; ++x) {
      const Color& color = drawn.at({x + 0.5, y + 0.5});
      if (color[0] > color[2] + 60) ++red;
      if (color[2] > color[0] + 60) ++blue;
    }
  return {red, blue};
}

TEST_F(CompareResults, EqualOnesAreEqualInEveryField) {
  write(MadeRun{}, "actual");
  const auto comparisons = compareData(ComparedKind::Result, dir_ / "actual", dir_ / "baseline", {});
  EXPECT_THAT(namesIn(findingsIn(comparisons)), IsEmpty());
  ASSERT_EQ(comparisons.size(), 1U);
  const std::vector<FieldComparison>& fields = comparisons.front().fields;
  std::set<std::string> names;
  for (const FieldComparison& field : fields) names.insert(field.name);
  EXPECT_EQ(names.size(), fields.size());
  for (const char* name : {"frames", "mesh.control_points", "mesh.weights", "mesh.knots", "displacement",
                           "plastic_strain", "contact.quadrature_friction (disc on top)",
                           "tool.displacement (disc)", "history", "history.disc.fy"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(CompareResults, SeveralBelowDirectoriesAreComparedPairByPair) {
  write(MadeRun{}, "new/same");
  write(MadeRun{}, "old/same");
  MadeRun changed;
  changed.spoil = [](FrameRecord& frame) { frame.fields.at("plastic_strain").values(0, 20) = 7; };
  write(changed, "new/deep/changed");
  write(MadeRun{}, "old/deep/changed");
  write(MadeRun{}, "new/added");
  write(MadeRun{}, "old/gone");
  write(MadeRun{}, "new/broken");
  write(MadeRun{}, "old/broken");
  writeText("no result", dir_ / "new/broken/result/frame_000001.h5");
  writeText("no mesh", dir_ / "new/same/frames/body.vtu");  // a run is compared as a whole
  const auto found = [&](auto... also) {
    return compareData(ComparedKind::Directory, dir_ / "new", dir_ / "old", {}, also...);
  };
  auto comparisons = found();
  const auto is = [](const char* name, const char* verdict) {
    return testing::AllOf(testing::Field(&Finding::name, name), testing::Field(&Finding::verdict, verdict));
  };
  EXPECT_THAT(findingsIn(comparisons),
              ElementsAre(is("added: result", "no-baseline"), is("broken: result", "unusable"),
                          is("deep/changed: plastic_strain", "different"), is("gone: result", "no-actual")));
  EXPECT_EQ(makeBaseline(comparisons, {}).size(), 2U);
  for (const auto& again : {comparisons, found()})
    EXPECT_THAT(findingsIn(again),
                ElementsAre(is("broken: result", "unusable"), is("gone: result", "no-actual")));
}

TEST_F(CompareResults, NewBaselineHasNothingOfTheOldOne) {
  MadeRun shorter;
  shorter.times.pop_back();
  write(shorter, "actual");
  auto comparisons = compareData(ComparedKind::Result, dir_ / "actual", dir_ / "baseline", {});
  EXPECT_EQ(makeBaseline(comparisons, {}).size(), 1U);
  EXPECT_THAT(findingsIn(comparisons), IsEmpty());
  EXPECT_FALSE(fs::exists(dir_ / "baseline/result/frame_000002.h5"));
  comparisons = compareData(ComparedKind::Result, dir_ / "actual", dir_ / "first", {}, true);
  EXPECT_THAT(findingsIn(comparisons), isOnly("result", "no-baseline", "first"));
  EXPECT_EQ(makeBaseline(comparisons, {}).size(), 1U);
  EXPECT_THAT(findingsIn(compareData(ComparedKind::Result, dir_ / "actual", dir_ / "first", {})), IsEmpty());
}

TEST_F(CompareResults, WorstPlaceIsDrawnOnBothSidesAndAsADifference) {
  MadeRun run;
  run.spoil = [](FrameRecord& frame) {
    frame.fields.at("plastic_strain").values(0, 20) += 0.5;
    frame.displacement(1, 30) += 0.01;
  };
  run.rows.back().back() += 1.0;
  write(run, "actual");
  const auto comparisons = compareData(ComparedKind::Result, dir_ / "actual", dir_ / "baseline", {});
  const auto worst = worstFields(comparisons, 9);
  ASSERT_GE(worst.size(), 3U);
  EXPECT_EQ(worst.front().field->name, "plastic_strain");
  EXPECT_TRUE(worst.back().field->name.starts_with("history."));
  EXPECT_EQ(worstFields(comparisons, 1).size(), 1U);
  const WorstPictures drawing(worst);
  std::vector<FieldPictures> pictures;
  for (const WorstField& each : worst) pictures.push_back(drawing.draw(each));
  for (const auto* one : {&pictures.front(), &pictures.back()})
    for (const auto picture : {&FieldPictures::baseline, &FieldPictures::actual, &FieldPictures::difference})
      EXPECT_TRUE(((*one).*picture).starts_with("\x89PNG"));
  EXPECT_NE(pictures.front().baseline, pictures.front().actual);

  // The difference is red round the control point that differs, and pale elsewhere.
  EXPECT_EQ(drawWorst(comparisons, dir_ / "worst.png"), "difference of plastic_strain");
  EXPECT_EQ(readText(dir_ / "worst.png"), pictures.front().difference);
  const auto [red, blue] = redAndBlueIn(dir_ / "worst.png");
  EXPECT_GT(red, 200);
  EXPECT_EQ(blue, 0);
}

TEST(Annotations, TellServicesWhatFailed) {
  const std::vector<ComparedCase> cases{{"a", CaseOutcome::Passed, "equal", "equal"},
                                        {"b: c,d", CaseOutcome::Failed, "different", "50 % of\nall: 3, 4"},
                                        {"e", CaseOutcome::Error, "unusable", "damaged"}};
  EXPECT_EQ(githubAnnotations(cases),
            "::error title=b%3A c%2Cd::50 %25 of%0Aall: 3, 4\n::error title=e::damaged\n");
  Json::Value issues;
  ASSERT_TRUE(Json::Reader().parse(codeQualityText(cases, "base/press"), issues));
  ASSERT_EQ(issues.size(), 2U);
  EXPECT_EQ(issues[0]["description"], "b: c,d: 50 % of\nall: 3, 4");
  EXPECT_EQ(issues[0]["location"]["path"], "base/press");
  EXPECT_EQ(issues[0]["location"]["lines"]["begin"], 1);
  EXPECT_EQ(issues[0]["severity"], "major");
  EXPECT_EQ(issues[1]["severity"], "critical");
  EXPECT_NE(issues[0]["fingerprint"], issues[1]["fingerprint"]);
  ASSERT_TRUE(Json::Reader().parse(codeQualityText({}, "base"), issues));
  EXPECT_EQ(issues.size(), 0U);
}

TEST_F(CompareResults, OneValueOfAField) {
  const auto found =
      findings([](FrameRecord& frame) { frame.fields.at("plastic_strain").values(0, 20) = 7; });
  EXPECT_THAT(found, isOnly("plastic_strain", "different", "1 of 336 values"));
  const std::string& message = found.front().message;
  EXPECT_THAT(message, HasSubstr("worst at time 1, control point 20 at (1.375, "));
  EXPECT_THAT(message, HasSubstr("found 7, the baseline has 0"));
}

TEST_F(CompareResults, OneDisplacementWithItsDirectionAndUnit) {
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.displacement(1, 3) += 0.25; }),
              isOnly("displacement", "different",
                     "control point 3 at (0.625, 0): y: found 0.25, the baseline has -0 mm"));
}

TEST_F(CompareResults, AMovedControlPoint) {
  MadeRun run;
  run.sample.model.mesh.patches[0].points(0, 5) += 1e-3;
  EXPECT_THAT(findings(run), isOnly("mesh.control_points", "different", "control point 5 at"));
}

TEST_F(CompareResults, AnotherWeightAndAMovedKnot) {
  MadeRun run;
  run.sample.model.mesh.patches[0].weights(5) = 1.5;
  EXPECT_THAT(findings(run), isOnly("mesh.weights", "different", "found 1.5, the baseline has 1"));
  run = MadeRun{};
  run.sample.model.mesh.patches[0].directions[0].knots[4] += 0.01;
  EXPECT_THAT(findings(run), isOnly("mesh.knots", "different", "knot 4: "));
}

TEST_F(CompareResults, AnotherMeshIsNamedOnceAndHistoriesAreCompared) {
  MadeRun run;
  run.sample = slabUnderADisc(samples::slab({10, 6}));
  run.rows[2][2] = 4.5;
  const auto found = findings(run);
  const std::vector<std::string> names = namesIn(found);
  ASSERT_THAT(names, testing::Contains("mesh"));
  EXPECT_THAT(names, testing::Contains("history.disc.fy"));
  EXPECT_THAT(names, testing::Not(testing::Contains("displacement")));
  EXPECT_EQ(std::ranges::count(found, "meshes-differ", &Finding::verdict), 1);
  EXPECT_THAT(std::ranges::find(found, "mesh", &Finding::name)->message,
              HasSubstr("found 12 x 8 B-splines of degree 2 x 2; the baseline has 14 x 8 B-splines"));
}

TEST_F(CompareResults, AMissingFieldAndOneMore) {
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.fields.erase("plastic_strain"); }),
              isOnly("plastic_strain", "no-actual", "missing at time 1"));
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.fields["heat"] = frame.fields.at("plastic_strain"); }),
              isOnly("heat", "no-baseline", "at time 1"));
}

TEST_F(CompareResults, AnotherUnit) {
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.fields.at("plastic_strain").unit = "%"; }),
              isOnly("plastic_strain", "units-differ", "found the unit %; the baseline has no unit"));
}

TEST_F(CompareResults, OtherComponents) {
  EXPECT_THAT(findings([](FrameRecord& frame) {
                FieldRecord& field = frame.fields.at("plastic_strain");
                field.values = field.values.replicate(2, 1).eval();
                field.components = {"xx", "yy"};
              }),
              isOnly("plastic_strain", "components-differ", "found 2 (xx yy); the baseline has 1"));
}

TEST_F(CompareResults, AMissingFrameAndOneMore) {
  MadeRun run;
  run.times = {0.0, 1.0};
  EXPECT_THAT(findings(run),
              isOnly("frames", "times-differ", "missing times of the baseline: 1 (0.5); 2 in common"));
  run.times = {0.0, 0.5, 0.75, 1.0};
  EXPECT_THAT(findings(run),
              isOnly("frames", "times-differ", "the baseline does not have: 1 (0.75); 3 in common"));
  EXPECT_THAT(findings(run, {.tolerance = {}, .fields = {}, .only = {}, .skip = {"frames"}}), IsEmpty());
}

TEST_F(CompareResults, NothingInCommonIsNeverEqual) {
  MadeRun run;
  run.times = {7.0};
  const DataRule lenient{.tolerance = {}, .fields = {}, .only = {}, .skip = {"frames"}};
  EXPECT_THAT(findings(run, lenient), isOnly("frames", "times-differ", "0 in common"));
  run = MadeRun{};
  run.sample = slabUnderADisc(samples::slab({10, 6}));
  EXPECT_THAT(findings(run, {.tolerance = {}, .fields = {}, .only = {"displacement"}, .skip = {}}),
              isOnly("mesh", "meshes-differ", "nothing on it is compared"));
  EXPECT_THAT(findings(run, {.tolerance = {}, .fields = {}, .only = {"history*"}, .skip = {}}), IsEmpty());
}

TEST_F(CompareResults, AnotherTime) {
  MadeRun run;
  run.times = {0.0, 0.5001, 1.0};
  EXPECT_THAT(findings(run),
              isOnly("frames", "times-differ", "(0.5); times that the baseline does not have: 1 (0.5001)"));
  run.times = {0.0, 0.5 + 1e-15, 1.0};
  EXPECT_THAT(findings(run), IsEmpty()) << "rounding of a time";
}

TEST_F(CompareResults, AContactPressureWithItsPair) {
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.contact[0].quadraturePressure(24) += 1; }),
              isOnly("contact.quadrature_pressure (disc on top)", "different", "quadrature point 24 at ("));
}

TEST_F(CompareResults, AToolElsewhere) {
  EXPECT_THAT(findings([](FrameRecord& frame) { frame.toolDisplacement(0, 0) += 0.5; }),
              isOnly("tool.displacement (disc)", "different", "worst at time 1: x: found "));
}

TEST_F(CompareResults, AnotherTool) {
  MadeRun run;
  run.sample.model.tools[0].name = "ball";
  run.sample.frame.contact[0].tool = "ball";
  EXPECT_THAT(namesIn(findings(run)),
              testing::IsSupersetOf({"tool.displacement (disc)", "tool.displacement (ball)",
                                     "contact.pressure (ball on top)"}));
}

TEST_F(CompareResults, AValueInAHistoryAndAMissingColumn) {
  MadeRun run;
  run.rows[1][2] = 2.5;
  EXPECT_THAT(findings(run),
              isOnly("history.disc.fy", "different", "worst at time 0.5: found 2.5, the baseline has 2"));
  run = MadeRun{};
  run.columns.pop_back();
  for (std::vector<double>& row : run.rows) row.pop_back();
  EXPECT_THAT(findings(run), isOnly("history.disc.fy", "no-actual", "missing at time 0"));
  run = MadeRun{};
  write(run, "actual");
  fs::remove(dir_ / "actual" / "history.csv");
  const auto without = [&](const DataRule& rule) {
    return findingsIn(compareData(ComparedKind::Result, dir_ / "actual", dir_ / "baseline", rule));
  };
  EXPECT_THAT(without({}), isOnly("history", "times-differ", "missing times of the baseline: 3 (0, 0.5, 1)"));
  EXPECT_THAT(without({.tolerance = {}, .fields = {}, .only = {"displacement"}, .skip = {}}), IsEmpty());
  EXPECT_THAT(without({.tolerance = {}, .fields = {}, .only = {}, .skip = {"history*"}}), IsEmpty());
  run.rows.pop_back();
  EXPECT_THAT(findings(run), isOnly("history", "times-differ", "missing times of the baseline: 1 (1)"));
}

TEST_F(CompareResults, ABodyIsNamed) {
  MadeRun run;
  run.sample = samples::twoBodies();
  write(run, "baseline");
  run.spoil = [](FrameRecord& frame) { frame.displacement(0, frame.displacement.cols() - 1) = 1; };
  EXPECT_THAT(findings(run), isOnly("displacement", "different", " of body stamp at (4.5, 1): x: "));
}

TEST_F(CompareResults, JustWithinAndJustBeyondEachTolerance) {
  constexpr double kLargest = 1.0;  // of the field, set below
  const auto off = [](double by) {
    return [by](FrameRecord& frame) { frame.fields.at("plastic_strain").values(0, 20) += by; };
  };
  MadeRun baseline;
  baseline.sample.frame.fields.at("plastic_strain").values(0, 40) = kLargest;
  write(baseline, "baseline");
  const auto differs = [&](double by, const DataRule& rule) {
    MadeRun run = baseline;
    run.spoil = off(by);
    return !findings(run, rule).empty();
  };
  EXPECT_FALSE(differs(0.99e-6, {}));
  EXPECT_TRUE(differs(1.01e-6, {}));
  const DataRule absolute{
      .tolerance = {.relative = 0, .absolute = 1e-3}, .fields = {}, .only = {}, .skip = {}};
  EXPECT_FALSE(differs(0.99e-3, absolute));
  EXPECT_TRUE(differs(1.01e-3, absolute));
  const DataRule larger{
      .tolerance = {.relative = 1e-2, .absolute = 1e-3}, .fields = {}, .only = {}, .skip = {}};
  EXPECT_FALSE(differs(0.99e-2, larger)) << "within either is enough";
  EXPECT_TRUE(differs(1.01e-2, larger));
  const DataRule own{.tolerance = {},
                     .fields = {fieldToleranceFromText("--tolerance", "plastic*=1e-2")},
                     .only = {},
                     .skip = {}};
  EXPECT_FALSE(differs(0.99e-2, own));
  EXPECT_TRUE(differs(1.01e-2, own));
  const DataRule other{.tolerance = {},
                       .fields = {fieldToleranceFromText("--tolerance", "displacement=1,5")},
                       .only = {},
                       .skip = {}};
  EXPECT_TRUE(differs(1.01e-6, other)) << "of another field";
}

TEST_F(CompareResults, OnlySomeFieldsAndAllButSome) {
  const auto spoil = [](FrameRecord& frame) {
    frame.displacement(1, 3) += 0.25;
    frame.toolDisplacement(0, 0) += 0.5;
  };
  const auto named = [&](const std::vector<std::string>& only, const std::vector<std::string>& skip) {
    return namesIn(findings(spoil, {.tolerance = {}, .fields = {}, .only = only, .skip = skip}));
  };
  EXPECT_THAT(named({"displacement"}, {}), ElementsAre("displacement"));
  EXPECT_THAT(named({"plastic_strain", "history.*"}, {}), IsEmpty());
  EXPECT_THAT(named({}, {"*displacement"}), IsEmpty());
  EXPECT_THAT(messageOf([&] { named({"displacment"}, {}); }),
              testing::AllOf(HasSubstr("--only: found no field \"displacment\"; expected one of "),
                             HasSubstr(", plastic_strain, "), HasSubstr(". Did you mean \"displacement\"?")));
  EXPECT_THAT(messageOf([&] { named({}, {"heat"}); }),
              testing::AllOf(HasSubstr("--skip: found no field \"heat\"; expected one of "),
                             HasSubstr("displacement"), testing::EndsWith(".")));
}

TEST(CompareSeries, NotANumberOnOneSideIsNoEqualValueAndOnBothIsOne) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto series = [](double value) {
    return DataSeries{.name = "", .isTimed = false, .frame = [value](std::size_t) {
                        DataPart part{.name = "row", .numPlaces = 1};
                        part.arrays = {{"q", "", {}, Eigen::MatrixXd::Constant(1, 1, value)}};
                        return DataFrame{part};
                      }};
  };
  const auto verdict = [&](double a, double b) {
    std::vector<std::string> names;
    return compareSeries(
               series(a), series(b),
               {.tolerance = {.relative = 1e9, .absolute = 1e9}, .fields = {}, .only = {}, .skip = {}}, names)
        .front()
        .verdict;
  };
  EXPECT_EQ(verdict(nan, nan), FieldVerdict::Equal);
  EXPECT_EQ(verdict(nan, 1), FieldVerdict::NotANumber);
  EXPECT_EQ(verdict(1, nan), FieldVerdict::NotANumber);
  EXPECT_EQ(verdict(infinite, infinite), FieldVerdict::Equal);
  EXPECT_EQ(verdict(infinite, -infinite), FieldVerdict::Different);
  EXPECT_EQ(verdict(1, infinite), FieldVerdict::Different);
}

TEST(DataRule, ToleranceAsText) {
  const FieldTolerance found = fieldToleranceFromText("--tolerance", "stress=1e-4,0.5");
  EXPECT_EQ(found.pattern, "stress");
  EXPECT_EQ(found.tolerance.relative, 1e-4);
  EXPECT_EQ(found.tolerance.absolute, 0.5);
  for (const char* text :
       {"stress", "=1", "stress=", "stress=-1", "stress=1,", "stress=nan", "stress=1e-4x", "stress=1,2,3"})
    EXPECT_THAT(messageOf([&] { fieldToleranceFromText("--tolerance", text); }),
                HasSubstr("expected NAME=R or NAME=R,A"))
        << text;
}

/// Two triangles with a number and a vector at each point and a number in each cell.
class CompareVtk : public DataFiles {
 protected:
  struct Grid {
    Eigen::Matrix3Xd points{{0, 1, 1, 0}, {0, 0, 1, 1}, {0, 0, 0, 0}};
    std::vector<std::vector<vtkIdType>> cells{{0, 1, 2}, {0, 2, 3}};
    std::map<std::string, std::vector<double>> atPoints{{"von_mises [MPa]", {1, 2, 3, 4}}};
    std::map<std::string, std::vector<double>> inCells{{"material", {5, 6}}};
    Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(3, 4);  ///< a vector at points
  };

  CompareVtk() { write({}, "baseline.vtu"); }

  void write(const Grid& made, const std::string& name) const {
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(makePoints(made.points));
    for (const std::vector<vtkIdType>& cell : made.cells)
      grid->InsertNextCell(cell.size() == 3 ? 5 : 9, static_cast<vtkIdType>(cell.size()), cell.data());
    for (const auto& [array, values] : made.atPoints)
      grid->GetPointData()->AddArray(
          makeArray(array, Eigen::Map<const Eigen::RowVectorXd>(values.data(), std::ssize(values)), {}));
    grid->GetPointData()->AddArray(makeArray("pull", made.pull, {}));
    for (const auto& [array, values] : made.inCells)
      grid->GetCellData()->AddArray(
          makeArray(array, Eigen::Map<const Eigen::RowVectorXd>(values.data(), std::ssize(values)), {}));
    writeVtkFile(*grid, 1.0, dir_ / name);
  }

  std::vector<Finding> findings(const Grid& grid) const {
    write(grid, "actual.vtu");
    return findingsIn(compareData(ComparedKind::VtkFile, dir_ / "actual.vtu", dir_ / "baseline.vtu", {}));
  }
};

TEST_F(CompareVtk, EveryDifferenceIsNamed) {
  EXPECT_THAT(findings({}), IsEmpty());
  Grid grid;
  grid.points(1, 2) = 1.25;
  EXPECT_THAT(findings(grid), isOnly("points", "different",
                                     "worst at point 2 at (1, 1, 0): y: found 1.25, the baseline has 1"));
  grid = {};
  grid.inCells["material"][1] = 7;
  EXPECT_THAT(
      findings(grid),
      isOnly(
          "cells.material", "different",
          "1 of 2 values by more than 6e-06; worst at cell 1 at (0.333333, 0.666667, 0): found 7, the baseline has 6"));
  grid = {};
  grid.atPoints["von_mises [MPa]"][3] = std::nan("");
  EXPECT_THAT(findings(grid), isOnly("von_mises", "not-a-number",
                                     "not a number on one side: 1 of 4 values; the first at point 3 at "
                                     "(0, 1, 0): found nan, the baseline has 4 MPa"));
  grid = {};
  grid.atPoints.clear();
  EXPECT_THAT(findings(grid), isOnly("von_mises", "no-actual", "missing: the baseline has it"));
  grid = {};
  grid.atPoints = {{"von_mises [GPa]", {1, 2, 3, 4}}};
  EXPECT_THAT(findings(grid),
              isOnly("von_mises", "units-differ", "found the unit GPa; the baseline has the unit MPa"));
  grid = {};
  grid.pull(1, 3) = 0.5;
  EXPECT_THAT(findings(grid), isOnly("pull", "different", ": y: found 0.5, the baseline has 0"));
  grid = {};
  grid.pull = Eigen::MatrixXd::Zero(2, 4);
  EXPECT_THAT(findings(grid),
              ElementsAre(testing::Field(&Finding::message,
                                         "components differ: found 2 (x y); the baseline has 3 (x y z)")));
  grid.pull = Eigen::MatrixXd::Zero(1, 4);
  EXPECT_THAT(findings(grid),
              ElementsAre(testing::Field(&Finding::message,
                                         "components differ: found 1; the baseline has 3 (x y z)")));
  grid = {};
  grid.atPoints["points"] = {1, 2, 3, 4};
  EXPECT_THAT(findings(grid), isOnly("points_2", "no-baseline", "it has nothing of the name"));
  grid = {};
  grid.cells[1] = {1, 2, 3};
  EXPECT_THAT(findings(grid),
              isOnly("cells.corners", "different", "corner 3 of cell 1: found 1, the baseline has 0"));
  grid = {};
  grid.cells.pop_back();
  grid.inCells["material"].pop_back();
  EXPECT_THAT(namesIn(findings(grid)), ElementsAre("cells", "cells.corners"));
  EXPECT_THAT(findings(grid).front().message, HasSubstr("found 1 cells; the baseline has 2"));
}

TEST_F(CompareVtk, DifferencesAreDrawnAndWhereOneSideIsNoNumber) {
  const double nan = std::nan("");
  const auto drawn = [&](const Grid& grid, const std::string& name) {
    write(grid, "actual.vtu");
    const auto comparisons =
        compareData(ComparedKind::VtkFile, dir_ / "actual.vtu", dir_ / "baseline.vtu", {});
    const auto worst = worstFields(comparisons, 1);
    EXPECT_EQ(worst.size(), 1U);
    const FieldPictures pictures = WorstPictures(worst).draw(worst.front());
    EXPECT_FALSE(pictures.baseline.empty());
    writeText(pictures.difference, dir_ / name);
    const auto [red, blue] = redAndBlueIn(dir_ / name);
    return std::tuple(!pictures.actual.empty(), red, blue);
  };
  Grid grid;
  grid.atPoints["von_mises [MPa]"][0] = 0;  // of both cells
  auto [hasActual, red, blue] = drawn(grid, "less.png");
  EXPECT_TRUE(hasActual);
  EXPECT_EQ(red, 0);
  EXPECT_GT(blue, 10000);
  grid = {};
  grid.pull(1, 3) = 0.5;
  write(grid, "actual.vtu");
  EXPECT_EQ(drawWorst(compareData(ComparedKind::VtkFile, dir_ / "actual.vtu", dir_ / "baseline.vtu", {}),
                      dir_ / "vector.png"),
            "difference of pull, component y");
  grid = {};
  grid.inCells["material"][1] = nan;
  std::tie(hasActual, red, blue) = drawn(grid, "cell.png");
  EXPECT_TRUE(hasActual) << "with a grey cell";
  EXPECT_GT(red, 20000) << "half of the square";
  EXPECT_EQ(blue, 0);
  const int half = red;
  grid = {};
  grid.inCells["material"] = {nan, nan};
  std::tie(hasActual, red, blue) = drawn(grid, "cells.png");
  EXPECT_FALSE(hasActual);
  EXPECT_NEAR(red, 2 * half, 0.02 * half);
  grid = {};
  grid.points(0, 2) = nan;
  std::tie(hasActual, red, blue) = drawn(grid, "point.png");
  EXPECT_FALSE(hasActual);
  EXPECT_GT(red, 10000);
  EXPECT_EQ(blue, 0);
}

TEST_F(CompareVtk, CollectionsAreMatchedByTimeAndPart) {
  const auto collection = [&](const std::string& name, const std::string& time, const std::string& file) {
    writeText(
        "<VTKFile type=\"Collection\"><Collection>\n<DataSet timestep=\"0\" part=\"0\" name=\"body\" "
        "file=\"baseline.vtu\"/>\n<DataSet timestep=\"" +
            time + "\" part=\"0\" name=\"body\" file=\"" + file + "\"/>\n</Collection></VTKFile>\n",
        dir_ / name);
  };
  Grid grid;
  grid.inCells["material"][1] = 7;
  write(grid, "other.vtu");
  collection("baseline.pvd", "0.5", "baseline.vtu");
  const auto found = [&] {
    return findingsIn(
        compareData(ComparedKind::VtkCollection, dir_ / "actual.pvd", dir_ / "baseline.pvd", {}));
  };
  collection("actual.pvd", "0.5", "other.vtu");
  EXPECT_THAT(found(), isOnly("cells.material (body)", "different", "worst at time 0.5, cell 1 at"));
  collection("actual.pvd", "0.6", "baseline.vtu");
  EXPECT_THAT(found(),
              isOnly("times", "times-differ", "(0.5); times that the baseline does not have: 1 (0.6)"));
  collection("actual.pvd", "x", "baseline.vtu");
  EXPECT_THAT(messageOf([&] { found(); }),
              HasSubstr("actual.pvd: found the timestep \"x\"; expected a number"));
  collection("actual.pvd", "0.5", "absent.vtu");
  EXPECT_THAT(messageOf([&] { found(); }), HasSubstr("absent.vtu: there is no such file"));
}

TEST_F(CompareVtk, DamagedFilesAreNamed) {
  const std::string whole = readText(dir_ / "baseline.vtu");
  const auto message = [&](const std::string& text) {
    writeText(text, dir_ / "damaged.vtu");
    return messageOf(
        [&] { compareData(ComparedKind::VtkFile, dir_ / "damaged.vtu", dir_ / "baseline.vtu", {}); });
  };
  EXPECT_EQ(message(whole), "");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, whole.size() / 4, whole.size() / 2, whole.size() - 20})
    EXPECT_THAT(message(whole.substr(0, length)),
                HasSubstr("damaged.vtu: this is no VTK file of its ending, or it is damaged"))
        << length;
  std::string many = whole;
  many.replace(many.find("NumberOfCells=\"2\""), 17, "NumberOfCells=\"99999999\"");
  EXPECT_THAT(message(many), HasSubstr("damaged.vtu: "));
}

TEST_F(DataFiles, KindsAreToldByPathAndNotMixed) {
  fs::create_directories(dir_ / "run");
  fs::create_directories(dir_ / "pictures");
  writeText("", dir_ / "run/result.h5");
  writeText("", dir_ / "pictures/a.png");
  writeText("", dir_ / "runs/a/result.h5");
  writeText("", dir_ / "runs/figure.png");
  writeText("", dir_ / "meshes/a/b.vtu");
  writeText("", dir_ / "drawn/b.vtu");
  writeText("", dir_ / "drawn/b.png");
  EXPECT_EQ(kindOf(dir_ / "runs", dir_ / "absent"), ComparedKind::Directory);
  EXPECT_EQ(kindOf(dir_ / "meshes", dir_ / "meshes"), ComparedKind::Directory);
  EXPECT_EQ(kindOf(dir_ / "drawn", dir_ / "drawn"), ComparedKind::Pictures);
  EXPECT_THAT(messageOf([&] { kindOf(dir_ / "run", dir_ / "runs"); }),
              HasSubstr("runs is a directory of results; expected two of a kind"));
  EXPECT_EQ(kindOf(dir_ / "run", dir_ / "run"), ComparedKind::Result);
  EXPECT_EQ(kindOf(dir_ / "run", dir_ / "run/result.h5"), ComparedKind::Result);
  EXPECT_EQ(kindOf(dir_ / "run", dir_ / "absent"), ComparedKind::Result);
  EXPECT_EQ(kindOf(dir_ / "pictures", dir_ / "absent"), ComparedKind::Pictures);
  EXPECT_EQ(kindOf(dir_ / "run", dir_ / "pictures"), ComparedKind::Pictures);
  EXPECT_EQ(kindOf(dir_ / "pictures", dir_ / "run"), ComparedKind::Pictures);
  EXPECT_EQ(kindOf("a.vtp", "b.vtu"), ComparedKind::VtkFile);
  EXPECT_EQ(kindOf("a.pvd", "b.pvd"), ComparedKind::VtkCollection);
  EXPECT_THAT(
      messageOf([&] { kindOf(dir_ / "run/result.h5", dir_ / "pictures"); }),
      HasSubstr("pictures is no data, but a picture or a directory of pictures; expected two of a kind"));
  EXPECT_THAT(messageOf([&] { kindOf("a.vtu", "b.pvd"); }),
              HasSubstr("a.vtu is a VTK file, b.pvd is a collection of VTK files"));
}

TEST(Junit, TellsTestsFailuresAndErrors) {
  EXPECT_EQ(junitText("a & b", {{"one", CaseOutcome::Passed, "equal", "equal"},
                                {"two <x>", CaseOutcome::Failed, "different", "found \"1\""},
                                {"three", CaseOutcome::Error, "unusable", "line\nend"}}),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="3" failures="1" errors="1">
  <testsuite name="a &amp; b" tests="3" failures="1" errors="1">
    <testcase classname="a &amp; b" name="one"/>
    <testcase classname="a &amp; b" name="two &lt;x&gt;">
      <failure type="different" message="found &quot;1&quot;"/>
    </testcase>
    <testcase classname="a &amp; b" name="three">
      <error type="unusable" message="line end"/>
    </testcase>
  </testsuite>
</testsuites>
)");
}

}  // namespace
}  // namespace burnish
