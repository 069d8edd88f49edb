#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/schema/json_schema.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/combinations.h"
#include "postproc/study/run_data.h"
#include "postproc/study/study_listing.h"
#include "postproc/study/study_reader.h"
#include "tests/engine/scene/scene_samples.h"

namespace burnish {
namespace {

using samples::replaced;

namespace fs = std::filesystem;
using testing::ElementsAre;

const std::string kScene = R"(geometry: {shape: rectangle, size: [2, 1], functions: [7, 5]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
steps: [{until: 1, count: 2}]
)";

const std::string kStudy = R"(title: Bases
runs:
  - name: block-{basis}-{degree}
    scene: block.yaml
    vary:
      - {name: basis, values: [nurbs, lagrange], labels: [NURBS, C0]}
      - {name: degree, values: [1, 2]}
    set: ["basis={basis}", "degree={degree}"]
    label: "{basis.label}, p = {degree}"
  - {name: soft, scene: block.yaml, set: [material.E=0.5]}
figures:
  - {name: energy, kind: history, runs: ["block-*", soft], y: strain_energy, looks: {color: basis}}
  - {name: map, kind: sheet, runs: [soft], times: [0, 1], time_labels: [start, end], field: von_mises}
  - {name: both, kind: composite, figures: [energy, map], captions: [a, b]}
statements:
  - name: work
    title: Work
    runs: ["block-*-2", soft]
    measures:
      - {name: peak, title: Peak, kind: history, y: strain_energy, reduce: max}
    claims:
      - {text: "{d}", measure: peak, vary: [{name: d, values: [1, 2]}], runs: ["block-nurbs-{d}", soft]}
    figures: [both]
)";

/// A directory with a scene and a study.
class StudyFile : public testing::Test {
 protected:
  StudyFile() {
    fs::create_directories(dir_);
    std::ofstream(dir_ / "block.yaml") << kScene;
  }
  ~StudyFile() override { fs::remove_all(dir_); }

  Study read(const std::string& text) const {
    std::ofstream(dir_ / "study.yaml") << text;
    return readStudy(dir_ / "study.yaml");
  }

  /// The error without the directory, of reading or of what is done with the study then.
  std::string errorOf(
      const std::string& text, const std::function<void(const Study&)>& use = [](const Study&) {}) const {
    try {
      use(read(text));
      return "no error";
    } catch (const Error& error) {
      std::string message = error.what();
      for (std::size_t at = 0; (at = message.find(dir_.string() + "/")) != std::string::npos;)
        message.erase(at, dir_.string().size() + 1);
      return message;
    }
  }

  fs::path dir_ = fs::temp_directory_path() / ("burnish_study_" + std::to_string(::getpid()));
};

std::vector<std::string> names(const std::vector<const StudyRun*>& runs) {
  std::vector<std::string> list;
  for (const StudyRun* run : runs) list.push_back(run->name);
  return list;
}

TEST_F(StudyFile, runsAreTheCombinationsOfTheParametersTheFirstSlowest) {
  const Study study = read(kStudy);
  EXPECT_THAT(names(study.matching({"*"})),
              ElementsAre("block-nurbs-1", "block-nurbs-2", "block-lagrange-1", "block-lagrange-2", "soft"));
  const StudyRun& run = study.runs[2];
  EXPECT_EQ(run.label, "C0, p = 1");
  EXPECT_EQ(run.scene, dir_ / "block.yaml");
  EXPECT_THAT(run.overrides, ElementsAre("basis=lagrange", "degree=1"));
  EXPECT_EQ(run.parameters,
            (std::map<std::string, std::string>{
                {"basis", "lagrange"}, {"basis.label", "C0"}, {"degree", "1"}, {"degree.label", "1"}}));
  EXPECT_EQ(study.runs[4].label, "soft");
}

TEST_F(StudyFile, figuresAndStatementsAreRead) {
  const Study study = read(kStudy);
  const auto& chart = std::get<HistoryFigure>(study.spec.figures.at(0).what);
  EXPECT_EQ(chart.x, "time");
  EXPECT_EQ(chart.looks.color, "basis");
  const auto& sheet = std::get<SheetFigure>(study.spec.figures.at(1).what);
  EXPECT_EQ(sheet.times, (std::vector<double>{0, 1}));
  EXPECT_EQ(sheet.panelCaption, "{letter}) {label}, {time}");
  const auto& measure = std::get<HistoryMeasure>(study.spec.statements.at(0).measures.at(0).what);
  EXPECT_EQ(measure.reduce, Reduction::Max);
}

TEST_F(StudyFile, aTimeMayBeTheEndOfTheRuns) {
  std::string text = kStudy;
  text.replace(text.find("times: [0, 1]"), 13, "times: [0, end]");
  const Study study = read(text);
  EXPECT_THAT(std::get<SheetFigure>(study.spec.figures[1].what).times, ElementsAre(0.0, kEndOfRun));
}

TEST_F(StudyFile, patternsNameRunsOnceInTheirOrder) {
  const Study study = read(kStudy);
  EXPECT_THAT(names(study.matching({"soft", "*-2", "block-nurbs-2"})),
              ElementsAre("soft", "block-nurbs-2", "block-lagrange-2"));
  EXPECT_THAT(names(study.matching({"b*k-*s-*1"})), ElementsAre("block-nurbs-1"));
  EXPECT_THROW(study.matching({"block"}), Error);
  EXPECT_THROW(study.matching({"soft", "*-3"}), Error);
}

TEST(FillIn, replacesEveryBrace) {
  const std::map<std::string, std::string> parameters{{"p", "2"}, {"p.label", "two"}};
  EXPECT_EQ(fillIn("a{p}-{p.label}{p}", parameters), "a2-two2");
  EXPECT_EQ(fillIn("", parameters), "");
  EXPECT_THROW(fillIn("{q}", parameters), Error);
  EXPECT_THROW(fillIn("a{p", parameters), Error);
}

TEST(Combinations, haveOneEmptyMemberWithoutParameters) {
  EXPECT_EQ(combinations({}).size(), 1u);
  EXPECT_TRUE(combinations({})[0].empty());
}

/// A mistake made in the good study, and the error that it gives.
struct MistakeOfStudy {
  const char* name;
  std::string from, to, error;
};

void PrintTo(const MistakeOfStudy& mistake, std::ostream* out) {
  *out << mistake.name;
}

class StudyMistake : public StudyFile, public testing::WithParamInterface<MistakeOfStudy> {};

std::string nameOfMistake(const testing::TestParamInfo<MistakeOfStudy>& test) {
  return test.param.name;
}

TEST_P(StudyMistake, isReportedWithPlaceKeyAndRemedy) {
  const std::string error = errorOf(replaced(kStudy, GetParam().from, GetParam().to));
  EXPECT_TRUE(error.starts_with(GetParam().error)) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << "only one thing is wrong:\n" << error;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, StudyMistake,
    testing::Values(
        MistakeOfStudy{"unknown", "title: Bases", "titel: Bases",
                       "study.yaml:1:1: titel: found an unknown key; allowed: title, text, runs, figures, "
                       "statements. Did you mean \"title\"?"},
        MistakeOfStudy{
            "unknownOfKind", "looks: {", "look: {",
            "study.yaml:12:78: figures[0].look: found an unknown key; allowed: name, caption, format, dpi, print_field, kind, runs"},
        MistakeOfStudy{
            "kind", "kind: sheet", "kind: shet",
            "study.yaml:13:23: figures[1].kind: found shet; allowed: history | surface | probe | roughness | refinement | "
            "sheet | setup | composite | animation. Did you mean \"sheet\"?"},
        MistakeOfStudy{"field", "field: von_mises", "field: mises",
                       "study.yaml:13:93: figures[1].field: found mises; allowed: displacement"},
        MistakeOfStudy{
            "dpiOfPixels", "y: strain_energy, looks", "dpi: 300, y: strain_energy, looks",
            "study.yaml:12:65: figures[0].dpi: found beside a PNG, which has pixels and no inches; "
            "leave it out, or take pdf or svg."},
        MistakeOfStudy{
            "animationForPrint", "kind: sheet, runs: [soft], times: [0, 1], time_labels: [start, end]",
            "kind: animation, format: pdf, runs: [soft]",
            "study.yaml:13:42: figures[1].format: found pdf; allowed: png, for this kind of figure is "
            "made of pixels."},
        MistakeOfStudy{"missing", "y: strain_energy, looks", "looks",
                       "study.yaml:12:5: figures[0].y: missing; required: a text."}),
    nameOfMistake);

INSTANTIATE_TEST_SUITE_P(
    Names, StudyMistake,
    testing::Values(
        MistakeOfStudy{"runTwice", "block-{basis}-{degree}", "block-{basis}",
                       "study.yaml:3:11: runs[0].name: found the name block-nurbs a second time"},
        MistakeOfStudy{
            "unsafeRun", "name: block-{basis}-{degree}", "name: ../{basis}-{degree}",
            "study.yaml:3:11: runs[0].name: found the name ../nurbs-1; allowed: up to 200 letters"},
        MistakeOfStudy{
            "brace", "label: \"{basis.label},", "label: \"{basis.lable},",
            "study.yaml:9:12: runs[0].label: found \"{basis.lable}, p = {degree}\", where {basis.lable} "
            "stands for nothing; allowed in braces: basis, basis.label, degree, degree.label. Did you "
            "mean \"basis.label\"?"},
        MistakeOfStudy{
            "openBrace", "name: block-{basis}-{degree}", "name: \"block-{basis}-{degree\"",
            "study.yaml:3:11: runs[0].name: found \"block-{basis}-{degree\": a brace is not closed"},
        MistakeOfStudy{"labels", "labels: [NURBS, C0]", "labels: [NURBS]",
                       "study.yaml:6:58: runs[0].vary[0].labels: found a list of 1; allowed: a list of 2"},
        MistakeOfStudy{"valueTwice", "values: [1, 2]}\n    set", "values: [2, 2]}\n    set",
                       "study.yaml:7:36: runs[0].vary[1].values[1]: found 2 a second time"},
        MistakeOfStudy{"figureTwice", "{name: map", "{name: energy",
                       "study.yaml:13:12: figures[1].name: found energy a second time"},
        MistakeOfStudy{
            "probePlaces", "sheet, runs: [soft], times: [0, 1], time_labels: [start, end], field: von_mises",
            "probe, runs: [soft], line: \"0,0:1,1\", depth: top@0",
            "study.yaml:13:50: figures[1].line: found line and depth; expected one of line, face, depth"},
        MistakeOfStudy{"probeTimes",
                       "sheet, runs: [soft], times: [0, 1], time_labels: [start, end], field: von_mises",
                       "probe, runs: [soft], point: \"0,0\", times: [0, 1]",
                       "study.yaml:13:65: figures[1].times: found times of values over time; allowed: none."},
        MistakeOfStudy{"timeLabels", "time_labels: [start, end]", "time_labels: [start]",
                       "study.yaml:13:72: figures[1].time_labels: found a list of 1; allowed: a list of 2"},
        MistakeOfStudy{"captions", "captions: [a, b]", "captions: [a]",
                       "study.yaml:14:69: figures[2].captions: found a list of 1; allowed: a list of 2"}),
    nameOfMistake);

INSTANTIATE_TEST_SUITE_P(
    References, StudyMistake,
    testing::Values(
        MistakeOfStudy{
            "scene", "scene: block.yaml\n", "scene: brick.yaml\n",
            "study.yaml:3:5: runs[0]: the scene of the run block-nurbs-1 cannot be used: brick.yaml: "
            "cannot be read"},
        MistakeOfStudy{
            "override", "set: [material.E=0.5]", "set: [material.nu=0.5]",
            "study.yaml:10:5: runs[1]: the scene of the run soft cannot be used: --set material.nu=0.5: "
            "material.nu: found 0.5; allowed: a number above -1 and below 0.5."},
        MistakeOfStudy{"pattern", "runs: [\"block-*\", soft]", "runs: [\"blok-*\", soft]",
                       "study.yaml:12:42: figures[0].runs[0]: found blok-*, which names no run; the runs are "
                       "block-nurbs-1, "},
        MistakeOfStudy{"looks", "color: basis", "color: base",
                       "study.yaml:12:93: figures[0].looks.color: found base; allowed: basis | degree."},
        MistakeOfStudy{"part", "figures: [energy, map]", "figures: [energy, both]",
                       "study.yaml:14:53: figures[2].figures[1]: found both; allowed: energy | map."},
        MistakeOfStudy{
            "measure", "measure: peak", "measure: peek",
            "study.yaml:22:32: statements[0].claims[0].measure: found peek; allowed: peak. Did you mean "
            "\"peak\"?"},
        MistakeOfStudy{"claimedRun", "soft]}", "hard]}", "study.yaml:22:99: statements[0].claims[0].runs[1]"},
        MistakeOfStudy{"oneRun", "runs: [\"block-nurbs-{d}\", soft]", "runs: [soft]",
                       "study.yaml:22:79: statements[0].claims[0].runs: found one run"},
        MistakeOfStudy{"between", "soft]}", "soft], expect: between}",
                       "study.yaml:22:9: statements[0].claims[0].range: required with between"},
        MistakeOfStudy{"within", "soft]}", "soft], within: 0.1}",
                       "study.yaml:22:114: statements[0].claims[0].within: found without equal or different"},
        MistakeOfStudy{
            "entry", "kind: history, y: strain_energy, reduce: max", "kind: summary, entry: iteratons",
            "study.yaml:20:57: statements[0].measures[0].entry: found iteratons; allowed: approach_iterations | "},
        MistakeOfStudy{"at", "reduce: max", "reduce: at",
                       "study.yaml:20:9: statements[0].measures[0].at: missing; required with `reduce: at`"},
        MistakeOfStudy{
            "figure", "figures: [both]", "figures: [all]",
            "study.yaml:23:15: statements[0].figures[0]: found all; allowed: energy | map | both."}),
    nameOfMistake);

/// A mistake that shows only in what the results of the runs will have.
class OutlookMistake : public StudyMistake {
 protected:
  std::string outlookErrorOf(const std::string& text) const {
    return errorOf(text, [](const Study& study) {
      RunOutlook outlook = outlookOf(parseSceneDocument(kScene, "block.yaml").scene);
      outlook.frameTimes = {0.0, 0.5, 1.0};
      outlook.columns = {"time", "strain_energy", "disc.fy"};
      std::vector<RunOutlook> outlooks(study.runs.size(), outlook);
      outlooks.front() = {};  // of which nothing is known
      requireOutlooks(study, outlooks);
    });
  }
};

TEST_P(OutlookMistake, isReportedWithPlaceKeyAndRemedy) {
  const std::string error = outlookErrorOf(replaced(kStudy, GetParam().from, GetParam().to));
  EXPECT_TRUE(error.starts_with(GetParam().error)) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << "only one thing is wrong:\n" << error;
}

INSTANTIATE_TEST_SUITE_P(
    Results, OutlookMistake,
    testing::Values(
        MistakeOfStudy{
            "column", "y: strain_energy, looks", "y: strain_enery, looks",
            "study.yaml:12:63: figures[0].y: run block-nurbs-2: formula \"strain_enery\", character 1: there is no "
            "column \"strain_enery\". Did you mean \"strain_energy\"? The columns are time, strain_energy, disc.fy"},
        MistakeOfStudy{
            "columnOfX", "y: strain_energy, looks", "y: 2*disc.fy, x: tme, looks",
            "study.yaml:12:77: figures[0].x: run block-nurbs-2: formula \"tme\", character 1: there is no column"},
        MistakeOfStudy{
            "columnOfMeasure", "y: strain_energy, reduce: max",
            "y: strain_energy, where: step > 1, reduce: max",
            "study.yaml:20:75: statements[0].measures[0].where: run block-nurbs-2: formula \"step > 1\", character "
            "1: there is no column \"step\""},
        MistakeOfStudy{
            "time", "times: [0, 1]", "times: [0, 0.75]",
            "study.yaml:13:55: figures[1].times[1]: found 0.75, but the run soft has no frame at that time, the "
            "nearest ones are at 0.5 and 1; allowed: a time of a frame, or output: {times: [0.75]} in the scene"},
        MistakeOfStudy{
            "timeBehindTheEnd", "times: [0, 1]", "times: [0, 2]",
            "study.yaml:13:55: figures[1].times[1]: found 2, but the run soft ends at t = 1; allowed: a time up to "
            "then."},
        MistakeOfStudy{
            "fieldOfAnotherLaw", "field: von_mises", "field: plastic_strain",
            "study.yaml:13:93: figures[1].field: run soft: found plastic_strain, but the material is elastic; "
            "allowed here: another field, such as von_mises."},
        MistakeOfStudy{
            "fieldOfContact", "field: von_mises", "field: contact_pressure",
            "study.yaml:13:93: figures[1].field: run soft: found contact_pressure, but the scene has no contact;"},
        MistakeOfStudy{
            "component", "field: von_mises", "field: stress.yz",
            "study.yaml:13:93: figures[1].field: run soft: found stress.yz, a component of three-dimensional scenes;"},
        MistakeOfStudy{
            "body", "field: von_mises", "field: von_mises, body: [block]",
            "study.yaml:13:111: figures[1].body[0]: found block, but the one body of the run soft has no name; "
            "leave the key out."},
        MistakeOfStudy{"cutInThePlane", "field: von_mises", "field: von_mises, cut: x=1",
                       "study.yaml:13:109: figures[1].cut: "},
        MistakeOfStudy{
            "line", "kind: history, y: strain_energy, reduce: max",
            "kind: line, field: plastic_strain, time: 0.5",
            "study.yaml:20:54: statements[0].measures[0].field: run block-nurbs-2: found plastic_strain, but"}),
    nameOfMistake);

TEST_F(OutlookMistake, NothingIsWrongWithWhatIsThere) {
  EXPECT_EQ(outlookErrorOf(kStudy), "no error");
  EXPECT_EQ(outlookErrorOf(replaced(kStudy, "times: [0, 1]", "times: [0.5, end]")), "no error");
}

TEST_F(StudyFile, filesThatAreNoStudyAreRefused) {
  EXPECT_EQ(errorOf(""), "study.yaml:1:1: the file is empty; a study has at least runs and figures");
  EXPECT_THAT(errorOf("- 1"),
              testing::StartsWith("study.yaml:1:1: found a list of 1 entry; a study is a mapping"));
  EXPECT_THROW(readStudy(dir_ / "nowhere.yaml"), Error);
}

TEST(StudyListing, isWhatTheDocumentationShows) {
  std::ifstream file(std::string(BURNISH_SOURCE_DIR) + "/docs/study.md");
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_NE(page.find(describeStudy()), std::string::npos)
      << "docs/study.md is out of date: replace its list by the output of burnish info --study-keys";
}

TEST(StudySchema, isTheOneThatIsShipped) {
  std::ifstream file(std::string(BURNISH_SOURCE_DIR) + "/docs/study.schema.json");
  const std::string shipped((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(shipped == jsonSchema("burnish study", studyDeclarations()))
      << "docs/study.schema.json is out of date: replace it by the output of burnish schema --study";
}

}  // namespace
}  // namespace burnish
