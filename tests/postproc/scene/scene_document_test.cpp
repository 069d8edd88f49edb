#include "postproc/scene/scene_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "engine/analysis/scene_report.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/error.h"
#include "engine/scene/schema.h"
#include "engine/schema/declaration_collector.h"
#include "postproc/scene/scene_listing.h"
#include "tests/engine/scene/scene_mistakes.h"
#include "tests/example_scenes.h"

/// What a scene's file says beyond what the engine computes: pictures, variants, checks, charts.
namespace burnish {
namespace {

using samples::block;
using samples::Mistake;
using samples::nameOf;
using samples::replaced;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string errorOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  try {
    parseSceneDocument(yaml, "test.yaml", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneDocument, ReadsWhatTheEngineLeavesAlone) {
  const SceneDocument document = parseSceneDocument(
      replaced(block, "{field: von_mises,", "{field: pressure}\n  - {field: von_mises, range: [0, 2],") +
          "variants: {families: [{name: a, set: [degree=3]}], meshes: [{size: 1}]}\n"
          "checks: [{name: force, quantity: cylinder.fy, expect: value, value: 1, relative: 0.1}]\n"
          "charts: [{x: time, y: cylinder.fy, y_title: force}]\n",
      "test.yaml");
  EXPECT_EQ(document.scene.body.degree, 2);
  ASSERT_EQ(document.pictures.size(), 2u);
  EXPECT_EQ(document.pictures[0].size, (std::array<int, 2>{1600, 900}));
  EXPECT_EQ(document.pictures[1].range, (std::array<double, 2>{0.0, 2.0}));
  EXPECT_THAT(document.pictures[1].times, ElementsAre(1.0, 1.5, 2.0));
  EXPECT_EQ(document.variants.value().families.at(0).name, "a");
  EXPECT_EQ(std::get<ExpectedValue>(document.checks.at(0).expect).relative, 0.1);
  EXPECT_EQ(document.charts.at(0).yTitle, "force");
}

TEST(SceneDocument, TellsTheEngineWhatIsWantedOfTheRun) {
  const Scene scene =
      parseSceneDocument(block + "checks: [{name: f, quantity: cylinder.fy, expect: range, at_least: 0}]\n" +
                             "charts: [{x: time, y: cylinder.fx}]\n",
                         "test.yaml")
          .scene;
  EXPECT_THAT(scene.wanted.frames, ElementsAre(1.0, 1.5, 2.0));
  ASSERT_EQ(scene.wanted.quantities.size(), 3u);
  EXPECT_EQ(scene.wanted.quantities[0].path, "checks[0].quantity");
  EXPECT_EQ(scene.wanted.quantities[0].formula, "cylinder.fy");
  EXPECT_EQ(scene.wanted.quantities[2].path, "charts[0].y");
  EXPECT_FALSE(scene.wanted.onlyWarns);
  EXPECT_TRUE(
      parseSceneDocument(block + "variants: {meshes: [{size: 1}]}\n", "test.yaml").scene.wanted.onlyWarns);

  const Scene late =
      parseSceneDocument(replaced(block, "times: [1, 1.5, 2]", "times: [0.123]"), "test.yaml").scene;
  const std::vector<TimePoint> grid = timeGrid(late, {});
  EXPECT_TRUE(std::any_of(grid.begin(), grid.end(), [](const TimePoint& l) { return l.time == 0.123; }));
}

TEST(SceneDocument, TakesTheEndOfTheRunAsATime) {
  EXPECT_THAT(
      parseSceneDocument(replaced(block, "times: [1, 1.5, 2]", "times: [1, end]"), "s").pictures[0].times,
      ElementsAre(1.0, 2.0));
}

TEST(SceneDocument, ResolvedYamlReadsBackToTheSameDocument) {
  const std::string yaml =
      replaced(block, "{field: von_mises,",
               "{field: stress.xx, range: [-1, 1e9], size: [400, 300], bands: 9, mirror: \"x,y=0.5\", "
               "tool_opacity: 0.5,") +
      "checks: [{name: force, quantity: cylinder.fy, expect: order, order: 2}]\n"
      "variants: {meshes: [{size: 4}, {size: 2}, {size: 1}]}\n";
  const SceneDocument document = parseSceneDocument(yaml, "test.yaml");
  const SceneDocument again = parseSceneDocument(document.scene.resolvedYaml, "again.yaml");
  EXPECT_EQ(again.scene.resolvedYaml, document.scene.resolvedYaml);
  EXPECT_EQ(again.pictures[0].range, document.pictures[0].range);
  EXPECT_EQ(Spelling<std::vector<MirrorPlane>>::write(again.pictures[0].mirror), "x,y=0.5");
  EXPECT_EQ(std::get<ExpectedOrder>(again.checks.at(0).expect).order, 2.0);
  EXPECT_EQ(again.variants.value().meshes.size(), 3u);
  EXPECT_NO_THROW(parseScene(document.scene.resolvedYaml, "the engine's part"));
}

TEST(SceneDocument, PicturesHaveWhatTheirThemeSaysUnlessTheySayIt) {
  const SceneDocument document =
      parseSceneDocument(replaced(block, "{field: von_mises,",
                                  "{knots: false, theme: complas, field: von_mises, isolines: 4, zoom: "
                                  "\"0,0,1,0.5\", vectors: displacement,"),
                         "test.yaml");
  const ScenePicture& picture = document.pictures[0];
  EXPECT_EQ(picture.colormap, "rainbow");
  EXPECT_EQ(picture.bands, 12);
  EXPECT_EQ(picture.isolines, 4);
  EXPECT_FALSE(picture.knots);
  EXPECT_EQ(picture.arrows, ArrowField::Displacement);
  EXPECT_EQ(picture.window.value().max(), Eigen::Vector2d(1.0, 0.5));
  EXPECT_THAT(document.scene.resolvedYaml, HasSubstr("bands: 12"));
}

TEST(SceneDocument, ThemeFilesOfPicturesAreRelativeToTheScene) {
  const auto directory = std::filesystem::temp_directory_path() / "burnish_scene_theme";
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "own.yaml") << "base: dark\npicture: {bands: 7}\n";
  const SceneDocument document =
      parseSceneDocument(replaced(block, "{field: von_mises,", "{field: von_mises, theme: own.yaml,"),
                         (directory / "test.yaml").string());
  EXPECT_EQ(document.pictures[0].bands, 7);
  EXPECT_EQ(document.pictures[0].theme.paper, themeNamed("dark").paper);
  EXPECT_EQ(parseSceneDocument(document.scene.resolvedYaml, "elsewhere.yaml").pictures[0].bands, 7);
  std::filesystem::remove_all(directory);
}

TEST(SceneDocument, PicturesForPrintHaveSizesOfPaper) {
  const SceneDocument document = parseSceneDocument(
      replaced(
          block, "{field: von_mises,",
          "{field: pressure, format: svg, size: [400, 300]}\n  - {field: von_mises, format: pdf, dpi: 300,"),
      "test.yaml");
  for (const SceneDocument& read :
       {document, parseSceneDocument(document.scene.resolvedYaml, "again.yaml")}) {
    EXPECT_EQ(read.pictures[0].size, (std::array<int, 2>{400, 300}));
    EXPECT_EQ(read.pictures[1].size, kPrintSize);
    EXPECT_EQ(read.pictures[1].format, PictureFormat::Pdf);
    EXPECT_EQ(read.pictures[1].dpi, 300);
  }
}

TEST(SceneDocument, NamesAllKeysThatTheEngineLeavesToOthers) {
  std::vector<std::string> keys, engine;
  for (const Declaration& declaration : sceneDeclarations()) keys.push_back(declaration.key);
  for (const Declaration& declaration : declarationsOf<Scene>()) engine.push_back(declaration.key);
  std::erase_if(keys, [&](const std::string& key) { return std::ranges::count(engine, key) > 0; });
  EXPECT_EQ(keys, keysOfDocuments());
}

class DocumentMistake : public testing::TestWithParam<Mistake> {};

TEST_P(DocumentMistake, IsReportedWithPlaceKeyAndRemedy) {
  samples::expectReported(GetParam(), [](const std::string& yaml) { return errorOf(yaml); });
}

INSTANTIATE_TEST_SUITE_P(
    Pictures, DocumentMistake,
    testing::Values(
        Mistake{
            "unknown", &block, "degree: 2", "degre: 2", "degre", "degre",
            "found an unknown key; allowed: title, units, basis, degree, kinematics, formulation, "
            "quadrature_points, definitions, geometry, material, initial, bodies, supports, loads, tools, contact, "
            "self_contact, steps, solver, stabilise, rezoning, output, pictures, probes, measures, variants, checks, "
            "charts. Did you mean \"degree\"?"},
        Mistake{"pairLength", &block, "{field: von_mises,", "{field: von_mises, size: [800],", "[800]",
                "pictures[0].size",
                "found a list of 1 entry; allowed: a list of 2 whole numbers above 0 and at most 8000."},
        Mistake{"tinyPicture", &block, "{field: von_mises,", "{field: von_mises, size: [10, 10],", "[10",
                "pictures[0].size", "found 10 x 10 pixels; expected 200 x 150 to 8000 x 8000"},
        Mistake{"narrowPicture", &block, "{field: von_mises,", "{field: von_mises, size: [160, 160],", "[160",
                "pictures[0].size", "found 160 x 160 pixels; expected 200 x 150 to 8000 x 8000"},
        Mistake{"theme", &block, "{field: von_mises,", "{field: von_mises, theme: drak,", "drak",
                "pictures[0].theme",
                "found \"drak\"; allowed: paper, dark, slide, complas, or a file that "
                "ends in .yaml. Did you mean \"dark\"?"},
        Mistake{"themeFile", &block, "{field: von_mises,", "{field: von_mises, theme: /absent/theme.yaml,",
                "/absent", "pictures[0].theme", "/absent/theme.yaml: cannot be read"},
        Mistake{"viewInThePlane", &block, "{field: von_mises,", "{field: von_mises, view: iso,", "iso",
                "pictures[0].view", "found \"iso\"; a plane body is only seen in its plane"},
        Mistake{"clipAndRange", &block, "{field: von_mises,", "{field: von_mises, range: [0, 1], clip: 99,",
                "99", "pictures[0].clip", "found beside range"},
        Mistake{"latePicture", &block, "times: [1, 1.5, 2]", "times: [1, 1.5, 2.5]", "2.5",
                "pictures[0].times[2]", "found 2.5; allowed: a time up to the end of the run at 2."},
        Mistake{"field", &block, "field: von_mises", "field: vonmises", "vonmises", "pictures[0].field",
                "found vonmises; allowed: displacement | displacement.x"},
        Mistake{"stressComponent", &block, "field: von_mises", "field: stress.yz", "stress.yz",
                "pictures[0].field", "found stress.yz, a component of three-dimensional scenes"},
        Mistake{"plasticStrain", &block, "field: von_mises", "field: plastic_strain", "plastic_strain",
                "pictures[0].field",
                "found plastic_strain, but the material is elastic; allowed here: another field"},
        Mistake{"range", &block, "{field: von_mises,", "{field: von_mises, range: [1, 1],", "1]",
                "pictures[0].range[1]", "found 1 after 1; allowed: numbers that increase"},
        Mistake{"rangeBeyondNumbers", &block, "{field: von_mises,",
                "{field: von_mises, range: [-1e308, 1e308],", "[-1e308", "pictures[0].range",
                "found -1e+308, 1e+308; allowed: two numbers up to 1e300 in magnitude"},
        Mistake{"mirror", &block, "{field: von_mises,", "{field: von_mises, mirror: w,", "w,",
                "pictures[0].mirror", "found \"w\"; allowed: one or more of x, y, z, each once, or x=V"},
        Mistake{"mirrorInThePlane", &block, "{field: von_mises,", "{field: von_mises, mirror: z=1,", "z=1",
                "pictures[0].mirror", "found \"z=1\"; allowed in two dimensions: planes of x and y."},
        Mistake{"cut", &block, "{field: von_mises,", "{field: von_mises, cut: z,", "z,", "pictures[0].cut",
                "found \"z\"; allowed: x=V, y=V or z=V, or X,Y,Z,NX,NY,NZ"},
        Mistake{"cutInThePlane", &block, "{field: von_mises,", "{field: von_mises, slice: x=1,", "x=1",
                "pictures[0].slice", "found a plane through a plane body; allowed: in three-dimensional"},
        Mistake{"toolOpacity", &block, "{field: von_mises,", "{field: von_mises, tool_opacity: 2,", "2,",
                "pictures[0].tool_opacity", "found 2; allowed: a number above 0 and at most 1"},
        Mistake{"pictureName", &block, "pictures:", "pictures:\n  - {field: von_mises}",
                "{field: von_mises, times", "pictures[1]",
                "found the file name von_mises a second time; allowed: a name of its own for each entry"}),
    nameOf);

const std::string kPress = R"(geometry: {shape: rectangle, size: [2, 1], spans: [4, 2]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports:
  - {face: bottom, fix: [x, y]}
tools:
  - {name: disc, shape: cylinder, center: [1, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}
contact:
  - {tool: disc, face: top}
steps: [{until: 1, count: 2}]
)";

const std::string kPressedPair = R"(bodies:
  - {name: block, geometry: {shape: rectangle, size: [2, 1], spans: [4, 2]}, material: {law: neo-hookean, E: 1, nu: 0.3}}
  - {name: plate, geometry: {shape: rectangle, size: [2, 1], spans: [3, 2], origin: [0, 1]}, material: {law: neo-hookean, E: 1, nu: 0.3}}
supports:
  - {body: block, face: bottom, fix: [x, y]}
  - {body: plate, face: top, move: {times: [0, 1], x: [0, 0], y: [0, -0.1]}}
contact:
  - {body: block, face: top, against: {body: plate, face: bottom}}
steps: [{until: 1, count: 2}]
)";

TEST(SceneDocument, RefusesContactFieldsThatNoFaceWillHave) {
  const std::string noContact = block.substr(0, block.find("tools:")) + "steps: [{until: 1, count: 1}]\n";
  EXPECT_THAT(errorOf(noContact + "pictures: [{field: contact_pressure}]\n"),
              HasSubstr("pictures[0].field: found contact_pressure, but the scene has no contact"));
  EXPECT_THAT(errorOf(kPress + "pictures: [{field: slip}]\n"),
              HasSubstr("pictures[0].field: found slip, but no contact of the scene has friction"));
  EXPECT_EQ(errorOf(replaced(kPress, "{tool: disc, face: top}", "{tool: disc, face: top, friction: 0.1}") +
                    "pictures: [{field: slip}]\nprobes: [{name: a, face: top, field: [sliding]}]\n"),
            "no error");
  EXPECT_THAT(
      errorOf(kPress + "probes: [{name: a, face: left, field: [contact_pressure]}]\n"),
      HasSubstr("probes[0].face: found left, which is in no contact; allowed for contact fields: top."));
}

TEST(SceneDocument, ProbesContactFieldsOfTheFaceOfAPairThatHasThem) {
  EXPECT_EQ(
      errorOf(kPressedPair + "probes: [{name: a, body: [block], face: top, field: [contact_pressure]}]\n"),
      "no error");
  EXPECT_THAT(
      errorOf(kPressedPair + "probes: [{name: a, body: [plate], face: bottom, field: [contact_pressure]}]\n"),
      HasSubstr("probes[0].face: found bottom, which a pair has as against; the other face has its "
                "contact fields; allowed for contact fields: top of block."));
}

/// What is wrong with a document or the model of its scene.
std::string reportErrorOf(const std::string& yaml) {
  try {
    reportOf(parseSceneDocument(yaml, "test.yaml").scene);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(DocumentReport, RefusesChecksOfColumnsThatNoHistoryHas) {
  const auto with = [](const std::string& quantity, const std::string& more = "") {
    return reportErrorOf(
        kPress + "definitions: [{name: F, formula: 2}]\nchecks:\n  - {name: force, quantity: " + quantity +
        ", expect: range, at_least: 0}\n" + more);
  };
  EXPECT_EQ(with("disc.fy/F + strain_energy"), "no error");
  EXPECT_THAT(
      with("disc.fyy"),
      testing::AllOf(StartsWith("test.yaml:12:29: checks[0].quantity: found disc.fyy, which is no column "
                                "of the history; allowed: step, time, disc.ux, disc.uy, "),
                     HasSubstr("Did you mean \"disc.fy\"?")));
  EXPECT_THAT(with("strain_enrgy/F"), HasSubstr("Did you mean \"strain_energy\"?"));
  EXPECT_THAT(with("disc.fy +"), HasSubstr("cannot be understood"));
  EXPECT_THAT(with("disc.fy", "charts: [{x: tiem, y: disc.fy}]\n"),
              StartsWith("test.yaml:13:14: charts[0].x: found tiem, which is no column"));
  const std::string variants =
      "variants: {families: [{name: listed, set: [\"output.reactions=true\"]}, {name: plain}]}\n";
  EXPECT_EQ(with("disc.fyy", variants), "no error") << "a variant may have it";
}

TEST(DocumentReport, WarnsOfColumnsThatTheSceneItselfDoesNotHave) {
  const auto report = reportOf(
      parseSceneDocument(
          kPress +
              "variants: {meshes: [{size: 1}]}\nchecks:\n  - {name: force, quantity: disc.fyy, expect: range, "
              "at_least: 0}\n",
          "test.yaml")
          .scene);
  EXPECT_THAT(report.warnings,
              ElementsAre(StartsWith("test.yaml:12:29: checks[0].quantity: found disc.fyy")));
}

TEST(DocumentReport, LooksForColumnsOfSupportsWhereTheHistoryHasThem) {
  const std::string yaml = replaced(kPress, "fix: [x, y]", "fix: [x, y], name: floor") +
                           "checks: [{name: c, quantity: floor.fy, expect: range, at_most: 0, source: s}]\n";
  EXPECT_EQ(errorOf(yaml, {"output.reactions=true"}), "no error");
  EXPECT_THAT(errorOf(yaml),
              HasSubstr("The history has columns of supports with output: {reactions: true}."));
}

const std::filesystem::path scenes = std::filesystem::path(BURNISH_SOURCE_DIR) / "scenes";

TEST(SceneDocument, OfThePaperAndTheExamplesAreRead) {
  for (const char* file : {"paper/elastic.yaml", "paper/plastic.yaml"})
    EXPECT_THAT(readSceneDocument(scenes / file).pictures.at(0).times, ElementsAre(1.0, 1.5, 2.0)) << file;
  const auto examples = samples::exampleScenes();
  for (const auto& file : examples) EXPECT_NO_THROW(readSceneDocument(file)) << file;
  EXPECT_GE(examples.size(), 3u);
}

}  // namespace
}  // namespace burnish
