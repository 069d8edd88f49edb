#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tests/engine/scene/scene_samples.h"
#include "tests/engine/scene/two_bodies_sample.h"
#include "tests/example_scenes.h"

namespace burnish {
namespace {

using namespace samples;

TEST(Scene, reportsEverythingThatIsWrongAtOnceInTheOrderOfTheFile) {
  std::string yaml = replaced(block, "nu: 0.3", "nu: 0.5");
  yaml = replaced(yaml, "tool: cylinder", "tool: disc");
  yaml = replaced(yaml, "radius: 0.5", "radius: -1");
  yaml = replaced(yaml, "degree: 2", "degree: two");
  EXPECT_EQ(
      errorOf(yaml),
      "test.yaml:2:9: degree: found two; allowed: a whole number from 1 to 10.\n"
      "test.yaml:4:42: material.nu: found 0.5; allowed: a number above -1 and below 0.5.\n"
      "test.yaml:10:67: tools[0].radius: found -1; allowed: a number above 0.\n"
      "test.yaml:13:12: contact[0].tool: found disc, but no tool has this name; allowed: cylinder | plate.");
}

TEST(Scene, limitsALongListOfErrors) {
  std::string yaml = "steps:\n";
  for (int i = 0; i < 1000; ++i) yaml += "  - {until: x, count: 1}\n";
  const std::string message = errorOf(yaml);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 20);
  EXPECT_NE(message.find("test.yaml and at least 180 more"), std::string::npos) << message;
}

TEST(Scene, namesWhatIsNotAYamlMapping) {
  EXPECT_EQ(errorOf(""),
            "test.yaml:1:1: the file is empty; a scene has at least geometry, material and steps");
  EXPECT_EQ(errorOf("# nothing but a comment\n").substr(0, 34), "test.yaml:1:1: the file is empty; ");
  EXPECT_EQ(errorOf("- 1\n- 2\n").substr(0, 38), "test.yaml:1:1: found a list of 2 entri");
  EXPECT_EQ(errorOf("degree: 2\nbasis: [nurbs\nsteps: 3\n").substr(0, 28), "test.yaml:3:6: malformed YAM");
  EXPECT_NE(errorOf(block + "---\ndegree: 3\n").find(":20:1: found a second YAML document"),
            std::string::npos);
  EXPECT_NE(errorOf("? [a, b]\n: 1\n" + block).find("test.yaml:1:3: a key must be a plain word"),
            std::string::npos);
}

TEST(Scene, survivesHostileNestingAndAliases) {
  EXPECT_NE(errorOf("title: " + std::string(100'000, '[')).find("nested deeper than 50 levels"),
            std::string::npos);
  EXPECT_NE(
      errorOf("title: " + std::string(60, '[') + std::string(60, ']')).find("nested deeper than 50 levels"),
      std::string::npos);
  EXPECT_NE(errorOf("a: &a {b: *a}\n").find("nested deeper than 50 levels"), std::string::npos);
  EXPECT_NE(errorOf("# a comment\n, and: let\ntitle: x\n").find("text that belongs to no key"),
            std::string::npos);
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) laughs += (k > 0 ? ", " : "") + last;
    laughs += "]\n";
  }
  EXPECT_NE(errorOf(laughs).find("more than 1000000 values"), std::string::npos);
}

TEST(Scene, refusesTextsThatCannotBeShown) {
  const std::string tooLong = "found a text of 1001 letters; allowed: up to 1000.";
  EXPECT_EQ(errorOf("title: " + std::string(1001, 'x') + "\n" + block), "test.yaml:1:8: title: " + tooLong);
  EXPECT_EQ(errorOf(block + "units: {length: " + std::string(1001, 'm') + "}\n").substr(0, 18),
            "test.yaml:20:17: u");
  EXPECT_EQ(errorOf(block, {"title=" + std::string(1001, 'x')}),
            "--set title=" + std::string(194, 'x') + "...: title: " + tooLong);
  EXPECT_EQ(errorOf(block, {"title=\x1B\xC3"}).substr(0, 24), "--set title=\\x1B\\xC3: ti");
  EXPECT_EQ(errorOf(replaced(block, "name: plate", "name: " + std::string(201, 'p'))),
            "test.yaml:11:12: tools[1].name: found a text of 201 letters; allowed: up to 200.");
  EXPECT_EQ(errorOf("title: ab\xFF\n" + block),
            "test.yaml:1:8: title: found the byte 0xFF as letter 3; allowed: text in UTF-8.");
  EXPECT_EQ(
      errorOf("title: \"a\\x07\"\n" + block),
      "test.yaml:1:8: title: found the control character U+0007 as letter 2; allowed: letters that can be "
      "shown.");
  EXPECT_EQ(errorOf("\"ti\\etle\": a\n" + block).substr(0, 48),
            "test.yaml:1:1: found the control character U+001");
  EXPECT_EQ(
      parseScene("title: >\n  Ein Prüfkörper, ε̄ 漢字\n  \U0001F600\n" + block, "test.yaml").title.back(),
      '\n');
}

TEST(Scene, takesConstantsInNumbersAndFormulas) {
  const Scene scene =
      parseScene(replaced(replaced(samples::block, "E: 1.0", "E: 2*pi"), "[1, 0]", "[pi*t, e]"), "s");
  EXPECT_EQ(std::get<NeoHookean::Parameters>(scene.body.material).E, 2.0 * std::numbers::pi);
  EXPECT_EQ(Formula(scene.loads[0].traction[0])(Eigen::Vector3d::Zero(), 2.0), 2.0 * std::numbers::pi);
  EXPECT_EQ(Formula(scene.loads[0].traction[1]).constant(), std::numbers::e);
  const Scene own =
      parseScene(replaced(samples::block, "basis: nurbs", "definitions: [{name: e, formula: 7}]"), "s");
  EXPECT_EQ(Formula({"2*e"}, own.definitions).constant(), 14.0) << "a name of the scene comes first";
  EXPECT_EQ(errorOf(replaced(samples::block, "E: 1.0", "E: 2*pie")),
            "test.yaml:4:33: material.E: found 2*pie; allowed: a number above 0.");
}

TEST(Scene, takesTheEndOfTheRunAsATime) {
  const Scene scene =
      parseScene(replaced(samples::block, "output: {every: 0.1,", "output: {times: [0.5, last],"), "s");
  EXPECT_EQ(scene.output.times, (std::vector<double>{0.5, 2.0}));
}

TEST(Scene, withAHundredThousandDefinitionsIsReadInSeconds) {
  for (const bool chain : {false, true}) {
    const int count = chain ? 10'000 : 100'000;  // a chain takes a parser for each of its links
    std::string yaml = samples::block + "definitions:\n";
    for (int k = 0; k < count; ++k)
      yaml += fmt::format("  - {{name: d{}, formula: {}}}\n", k,
                          chain && k > 0 ? fmt::format("d{} + 1", k - 1) : "2*X");
    yaml = replaced(yaml, "[1, 0]", fmt::format("[d{}, 0]", count - 1));
    const auto begin = std::chrono::steady_clock::now();
    const Scene scene = parseScene(yaml, "test.yaml");
    EXPECT_EQ(scene.definitions.size(), static_cast<std::size_t>(count));
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 60.0) << chain;
  }
}

TEST(Scene, namesAFileThatCannotBeRead) {
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      readScene(file);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(message("no/such.yaml"), "no/such.yaml: cannot be read: No such file or directory");
  const std::string directory = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(message(directory), directory + ": this is a directory; a scene is a YAML file");
}

TEST(Scene, fillsInDefaults) {
  const Scene scene = parseScene(
      "geometry: {shape: rectangle, size: [3, 1], spans: [4, 2]}\n"
      "material: {law: neo-hookean, E: 1e-3, nu: +0.25}\n"
      "tools: [{name: disc, shape: cylinder, center: [0, 2], radius: 1}]\n"
      "contact: [{tool: disc, face: top}]\n"
      "steps: [{until: 1, count: 1}]\n",
      "test.yaml");
  EXPECT_EQ(scene.source, "test.yaml");
  EXPECT_EQ(scene.dim(), 2);
  EXPECT_EQ(scene.body.basis, BasisChoice::Nurbs);
  EXPECT_EQ(scene.body.degree, 2);
  EXPECT_EQ(std::get<RectangleBody>(scene.body.geometry.shape).origin.given(), (std::vector<double>{0, 0}));
  const auto& material = std::get<NeoHookean::Parameters>(scene.body.material);
  EXPECT_EQ(material.E, 1e-3);
  EXPECT_EQ(material.nu, 0.25);
  EXPECT_EQ(material.volumetric, NeoHookean::Volumetric::Log);
  EXPECT_EQ(scene.contact.at(0).options.method, Enforcement::IntegralAugmentedLagrangian);
  EXPECT_FALSE(scene.contact.at(0).options.parameter.has_value());
  EXPECT_FALSE(scene.tools.at(0).motion.has_value());
  EXPECT_EQ(scene.solver.newton.tolerance, 1e-9);
  EXPECT_EQ(scene.output.subdivision, 4);
}

TEST(Scene, leavesKeysOfTheDocumentAroundItToOthers) {
  const Scene scene = parseScene(block + "checks: [nonsense]\nvariants: 3\ncharts: {}\n", "test.yaml");
  EXPECT_EQ(scene.resolvedYaml.find("pictures"), std::string::npos);
  EXPECT_TRUE(scene.wanted.frames.empty());
  EXPECT_TRUE(errorOf(block + "chekcs: []\n").starts_with("test.yaml:20:1: chekcs: found an unknown key"));
}

TEST(Scene, readsEveryValueOfAScene) {
  const Scene scene = parseScene(block, "test.yaml");
  EXPECT_EQ(std::get<RectangleBody>(scene.body.geometry.shape).size.given(), (std::vector<double>{3, 1}));
  EXPECT_EQ(scene.body.geometry.mesh.functions, (std::vector<int>{49, 25}));
  EXPECT_EQ(scene.supports.at(0).place.face, "bottom");
  EXPECT_EQ(scene.supports.at(0).fix, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(scene.loads.at(0).traction, (std::vector<FormulaText>{{"1"}, {"0"}}));
  EXPECT_EQ((*scene.loads.at(0).schedule)(0.5), 0.5);
  EXPECT_EQ(scene.tools.at(0).name, "cylinder");
  EXPECT_EQ(std::get<Cylinder>(scene.tools[0].shape).center.given(), (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(*scene.tools[0].motion->x, (std::vector<double>{0, 0, 2}));
  EXPECT_FALSE(scene.tools[0].motion->y.has_value());
  EXPECT_EQ(std::get<Plane>(scene.tools.at(1).shape).normal.given(), (std::vector<double>{0, -1}));
  EXPECT_EQ(scene.steps.at(1).count, 200);
  EXPECT_EQ(scene.output.every, 0.1);
}

TEST(Scene, controlNetKeepsItsDegrees) {
  const Scene scene = parseScene(net, "test.yaml");
  const auto& given = std::get<ControlNetBody>(scene.body.geometry.shape);
  EXPECT_EQ(given.degrees, (std::vector<int>{1, 2}));
  EXPECT_EQ(given.points.at(3), (std::vector<double>{2, 2}));
  EXPECT_EQ(given.weights.at(2), 0.7071067811865476);
  EXPECT_EQ(scene.body.degree, 1) << "none is raised";
  EXPECT_EQ(parseScene(net, "test.yaml", {"basis=lagrange"}).body.degree, 2) << "the highest of the net";
  EXPECT_EQ(scene.dim(), 2);
}

/// A scene beside a directory `nets` with the file of a control net.
class ControlNetFile : public testing::Test {
 protected:
  ControlNetFile()
      : directory_(std::filesystem::path(testing::TempDir()) / ("nets_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(directory_ / "nets");
    write("scene.yaml",
          "geometry: {shape: control-net, file: nets/ring.yaml, refine: [1, 4]}\n"
          "material: {law: neo-hookean, E: 1, nu: 0.3}\nsteps: [{until: 1, count: 1}]\n");
  }
  ~ControlNetFile() override { std::filesystem::remove_all(directory_); }

  void write(const char* file, const std::string& text) const { std::ofstream(directory_ / file) << text; }

  /// What is wrong with a scene that takes this net, without the directory.
  std::string errorWith(const std::string& netText) const {
    write("nets/ring.yaml", netText);
    try {
      readScene(directory_ / "scene.yaml");
    } catch (const Error& e) {
      std::string message = e.what();
      const std::string prefix = directory_.string() + "/";
      for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
      return message;
    }
    return "no error";
  }

  std::filesystem::path directory_;
  const std::string ring_ =
      "# a quarter ring\n"
      "degrees: [1, 2]\n"
      "knots: [[0, 0, 1, 1], [0, 0, 0, 1, 1, 1]]\n"
      "points: [[1, 0], [2, 0], [1, 1], [2, 2], [0, 1], [0, 2]]\n"
      "weights: [1, 1, 0.7071067811865476, 0.7071067811865476, 1, 1]\n";
};

TEST_F(ControlNetFile, isReadAndItsContentsStandInTheResolvedScene) {
  ASSERT_EQ(errorWith(ring_), "no error");
  const Scene scene = readScene(directory_ / "scene.yaml");
  EXPECT_EQ(scene.dim(), 2);
  EXPECT_EQ(std::get<ControlNetBody>(scene.body.geometry.shape).points.at(3), (std::vector<double>{2, 2}));
  EXPECT_EQ(scene.resolvedYaml.find("ring.yaml"), std::string::npos);
  const Scene again = parseScene(scene.resolvedYaml, "elsewhere/again.yaml");
  EXPECT_EQ(again.resolvedYaml, scene.resolvedYaml);
  EXPECT_EQ(again.body.geometry.mesh.refine, (std::vector<int>{1, 4}));
}

TEST_F(ControlNetFile, isNamedWithLineAndColumnWhenItIsWrong) {
  EXPECT_EQ(errorWith(replaced(ring_, "[2, 2]", "[2, two]")),
            "nets/ring.yaml:4:38: geometry.points[3][1]: found two; allowed: a number.");
  EXPECT_EQ(errorWith(replaced(ring_, "[1, 2]", "[1, 3]")).substr(0, 36),
            "nets/ring.yaml:3:23: geometry.knots[");
  EXPECT_EQ(
      errorWith(replaced(ring_, "weights", "weight")),
      "nets/ring.yaml:5:1: geometry.weight: found an unknown key; allowed: degrees, knots, points, weights. "
      "Did you mean \"weights\"?");
  EXPECT_EQ(errorWith(replaced(ring_, "degrees: [1, 2]\n", "")),
            "nets/ring.yaml:2:1: geometry.degrees: missing; required: degrees, knots and points.");
  EXPECT_EQ(errorWith("degrees: [1, 2\n").substr(0, 31), "nets/ring.yaml:2:1: geometry: m");
  EXPECT_EQ(errorWith("- 1\n"),
            "nets/ring.yaml:1:1: geometry: found a list of 1 entry; allowed: a mapping of "
            "degrees, knots, points and weights.");
}

/// The ring as GoTools has it, in space; the weight is one that numbers are divided by exactly.
const std::string kRingG2 =
    "200 1 0 4 10 20 30 255\n3 1\n2 2\n0 0 1 1\n3 3\n0 0 0 1 1 1\n"
    "1 0 0 1\n2 0 0 1\n0.5 +0.5 0 0.5\n1 1 0 .5\n0 1 0 1e0\n0 2 0 1\n";

/// The same as geomdl writes it: the second direction fastest.
const std::string kRingJson =
    "{\"shape\": {\"type\": \"surface\", \"count\": 1, \"data\": [\n"
    "  {\"type\": \"spline\", \"rational\": true, \"dimension\": 3, \"degree_u\": 1, \"degree_v\": 2,\n"
    "   \"knotvector_u\": [0.0, 0.0, 1.0, 1.0], \"knotvector_v\": [0, 0, 0, 1, 1, 1], \"size_u\": 2, \"size_v\": 3,\n"
    "   \"control_points\": {\"points\": [[1, 0, 0], [1, 1, 0.0], [0, 1, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]],\n"
    "   \"weights\": [1, 0.5, 1, 1, 0.5, 1]}, \"delta\": [0.05, 0.05], \"reversed\": 0}\n]}}\n";

TEST_F(ControlNetFile, ofOtherProgramsIsTheSameNet) {
  for (const auto& [name, text] : {std::pair{"ring.g2", kRingG2}, std::pair{"ring.json", kRingJson}}) {
    write((std::string("nets/") + name).c_str(), text);
    const Scene scene = readScene(directory_ / "scene.yaml", {std::string("geometry.file=nets/") + name});
    const auto& net = std::get<ControlNetBody>(scene.body.geometry.shape);
    EXPECT_EQ(net.degrees, (std::vector<int>{1, 2}));
    EXPECT_EQ(net.knots, (std::vector<std::vector<double>>{{0, 0, 1, 1}, {0, 0, 0, 1, 1, 1}}));
    EXPECT_EQ(net.points, (std::vector<std::vector<double>>{{1, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}}))
        << name;
    EXPECT_EQ(net.weights, (std::vector<double>{1, 1, 0.5, 0.5, 1, 1}));
  }
}

TEST_F(ControlNetFile, ofSeveralObjectsNeedsAnEntry) {
  write("nets/two.g2", kRingG2 + "\n" + replaced(kRingG2, "0 2 0 1\n", "0 3 0 1\n"));
  const auto read = [&](const std::vector<std::string>& overrides) {
    std::vector<std::string> all{"geometry.file=nets/two.g2"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return readScene(directory_ / "scene.yaml", all);
  };
  EXPECT_EQ(std::get<ControlNetBody>(read({"geometry.entry=1"}).body.geometry.shape).points.back(),
            (std::vector<double>{0, 3}));
  const auto errorOf = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      read(overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(errorOf({}),
              testing::HasSubstr("geometry.file: found a file of 2 objects; allowed: one, or entry: 0 to 1"));
  EXPECT_THAT(errorOf({"geometry.entry=2"}),
              testing::HasSubstr("geometry.entry: found 2; allowed: a whole number from 0 to 1"));
}

TEST_F(ControlNetFile, ofOtherProgramsIsNamedWithItsPlaceWhenItIsWrong) {
  const auto errorOf = [&](const std::string& name, const std::string& text) -> std::string {
    write(("nets/" + name).c_str(), text);
    try {
      readScene(directory_ / "scene.yaml", {"geometry.file=nets/" + name});
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  EXPECT_THAT(
      errorOf("ring.g2", replaced(kRingG2, "1e0", "one")),
      HasSubstr("nets/ring.g2:11:7: geometry: found one where a weight should stand; allowed: a number."));
  EXPECT_THAT(errorOf("ring.g2", replaced(kRingG2, "1 1 0 .5", "1 1 0 -.5")),
              HasSubstr("found a weight of -0.5; allowed: a number above 0."));
  EXPECT_THAT(errorOf("ring.g2", replaced(kRingG2, "0 2 0 1\n", "")),
              HasSubstr("the file ends where a coordinate should stand."));
  EXPECT_THAT(errorOf("ring.g2", replaced(kRingG2, "200 1", "210 1")),
              HasSubstr("nets/ring.g2:1:1: geometry: found an object of class 210"));
  EXPECT_THAT(errorOf("ring.g2", replaced(kRingG2, "0 0 0 1 1 1", "0 0 0 1 1 0")),
              HasSubstr("nets/ring.g2:6:1: geometry.knots[1]: knot vector"));
  EXPECT_THAT(
      errorOf("ring.json", replaced(kRingJson, "[2, 2, 0], ", "")),
      HasSubstr(
          "nets/ring.json:4:33: geometry: found 5 points; allowed: 6, as many as the knots make basis functions."));
  EXPECT_THAT(errorOf("ring.json", replaced(kRingJson, "\"degree_v\": 2", "\"degree_v\": 2.5")),
              HasSubstr("found 2.5; allowed: a degree, a whole number from 1 to 10."));
  EXPECT_THAT(errorOf("ring.json", "{\"shape\": 3}"), HasSubstr("found 3 as shape; allowed: a mapping."));
  EXPECT_THAT(
      errorOf("ring.json", replaced(kRingJson, "\"size_v\": 3", "\"size_v\": 4")),
      HasSubstr(
          "nets/ring.json:3:101: geometry: found 4 as size_v; allowed: 3, as many as the knots make basis "
          "functions."));
  EXPECT_THAT(errorOf("ring.json", replaced(kRingJson, "\"count\": 1", "\"count\": 2")),
              HasSubstr("geometry: found 2 as count; allowed: 1, as many as there are in data."));
  EXPECT_THAT(errorOf("ring.json", replaced(kRingJson, "\"surface\"", "\"volume\"")),
              HasSubstr("geometry: found type volume of a file that holds a surface; allowed: surface."));
  EXPECT_THAT(
      errorOf("ring.json",
              replaced(kRingJson, "\"reversed\": 0", "\"trims\": {\"count\": 1, \"data\": [{}]}")),
      HasSubstr("geometry: found a surface that is trimmed by curves; allowed: surfaces without trims."));
  EXPECT_EQ(
      errorOf("ring.json", replaced(kRingJson, "\"reversed\": 0", "\"trims\": {\"count\": 0, \"data\": []}")),
      "no error");
  EXPECT_THAT(
      errorOf("ring.json", replaced(kRingJson, "\"size_u\": 2,", "\"size_u\": 2")),
      HasSubstr("nets/ring.json:3:90: geometry: broken JSON; look at brackets, commas and quotes here"));
  EXPECT_THAT(errorOf("RING.JSON", "{\"shape\": 3"), HasSubstr("nets/RING.JSON:1:12: geometry: broken JSON"));
  EXPECT_EQ(errorOf("RING.G2", kRingG2), "no error");
  std::filesystem::create_directories(directory_ / "nets/folder");
  try {
    readScene(directory_ / "scene.yaml", {"geometry.file=nets/folder"});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("this is a directory; a control net is a YAML, g2, JSON, STEP or IGES file."));
  }
}

TEST_F(ControlNetFile, ofAProfileOrAToolIsFlattenedWhereThePlaneIsMeant) {
  write("nets/line.g2", "100 1 0 0\n3 0\n2 2\n0 0 1 1\n1 0 0\n0 0 0\n");
  write("made.yaml",
        "geometry: {shape: extrusion, profile: {file: nets/line.g2}, vector: [0, -1]}\n"
        "material: {law: neo-hookean, E: 1, nu: 0.3}\nsteps: [{until: 1, count: 1}]\n"
        "tools: [{name: wall, shape: nurbs, file: nets/line.g2}]\n");
  const Scene scene = readScene(directory_ / "made.yaml");
  EXPECT_EQ(scene.dim(), 2);
  EXPECT_EQ(std::get<ExtrusionBody>(scene.body.geometry.shape).profile.points,
            (std::vector<std::vector<double>>{{1, 0}, {0, 0}}));
  EXPECT_EQ(std::get<NurbsTool>(scene.tools.at(0).shape).points,
            (std::vector<std::vector<double>>{{1, 0}, {0, 0}}));
}

TEST_F(ControlNetFile, thatIsNotThereIsReportedWhereItIsNamed) {
  EXPECT_EQ(errorWith(ring_), "no error");
  std::filesystem::remove(directory_ / "nets/ring.yaml");
  try {
    readScene(directory_ / "scene.yaml", {"geometry.file=other.yaml"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()),
              "--set geometry.file=other.yaml: geometry.file: " + (directory_ / "other.yaml").string() +
                  ": cannot be read: No such file or directory.");
  }
}

TEST(Scene, boxMakesThreeDimensions) {
  const Scene scene = parseScene(
      "geometry: {shape: box, size: [1, 2, 3], spans: [2, 2, 2]}\n"
      "material: {law: neo-hookean, E: 1, nu: 0}\n"
      "supports: [{face: back, fix: [x, y, z]}]\n"
      "tools: [{name: ball, shape: sphere, center: [0, 0, 4], radius: 1, motion: {times: [0, 1], z: [0, "
      "-1]}}]\n"
      "contact: [{tool: ball, face: front}]\n"
      "steps: [{until: 1, count: 1}]\n",
      "test.yaml");
  EXPECT_EQ(scene.dim(), 3);
}

TEST(Scene, resolvedYamlReadsBackToTheSameScene) {
  const std::string title = "title: \"a \\\"b\\\": # é\\t~\"\n";
  std::string awkward = replaced(block, "E: 1.0", "E: 0.12345678901234568");
  awkward = replaced(awkward, "fix: [x, y]", "move: {times: [0, 0.3], x: [0, 1e-300], y: [0, 1]}");
  awkward = replaced(awkward, "method: augmented-lagrangian",
                     "method: penalty, parameter: 12.5, quadrature_points: 3");
  const std::string laws[] = {
      "{law: voce, sigma0: 1, sigma_inf: 2, beta: 3}",
      "{law: two-term-voce, sigma0: 1, q1: 2, beta1: 3, q2: 4, beta2: 5}",
      "{law: linear, sigma0: 1, modulus: 0}",
      "{law: voce-linear, sigma0: 1, sigma_inf: 2, beta: 3, modulus: 4}",
      "{law: formula, formula: 80 + 90 * (1 - exp(-18 * ep))}",
      "{law: ludwik, sigma0: 1, modulus: 2, exponent: 0.3}",
      "{law: swift, modulus: 2, ep0: 0.01, exponent: 0.3}",
      "{law: hockett-sherby, sigma0: 1, sigma_inf: 2, rate: 3, exponent: 0.5}",
  };
  const std::string creased =
      replaced(block, "functions: [49, 25]", "spans: [4, 4], grading: [s^2, s], creases: [[0.5], []]");
  std::vector<std::string> scenes{block, title + block, awkward, creased, net};
  for (const std::string& law : laws)
    scenes.push_back(replaced(net, hardening, "elastic: hencky, hardening: " + law));
  const std::string metal = replaced(net, "law: j2", "law: chaboche");
  for (const std::string more :
       {"", ", back_stresses: [{modulus: 1, recovery: 2}, {modulus: 3}]", ", rate: {law: norton, K: 1, N: 5}",
        ", rate: {law: johnson-cook, C: 0.1, rate0: 2}",
        ", rate: {law: formula, formula: \"sigma_y*(1 + rate^0.2)\"}",
        ", hill: {r0: 1, r45: 2, r90: 3, rolling: [0, 1, 0], transverse: [0, 0, 1]}, substeps: 3"})
    scenes.push_back(replaced(metal, hardening, hardening + more));
  for (const std::string& yaml : scenes) {
    const Scene scene = parseScene(yaml, "test.yaml");
    const Scene again = parseScene(scene.resolvedYaml, "again.yaml");
    EXPECT_EQ(again.resolvedYaml, scene.resolvedYaml);
    EXPECT_EQ(again.title, scene.title);
    EXPECT_EQ(again.body.degree, scene.body.degree);
    EXPECT_EQ(again.body.material.index(), scene.body.material.index());
    EXPECT_EQ(again.tools.size(), scene.tools.size());
    if (scene.tools.empty()) continue;
    EXPECT_EQ(std::get<NeoHookean::Parameters>(again.body.material).E,
              std::get<NeoHookean::Parameters>(scene.body.material).E);
    EXPECT_EQ(again.supports[0].move.has_value(), scene.supports[0].move.has_value());
    EXPECT_EQ(again.contact[0].options.parameter, scene.contact[0].options.parameter);
  }
  EXPECT_EQ(parseScene(title + block, "test.yaml").title, "a \"b\": # é\t~");
}

TEST(SceneOverride, setsMakesAndReplacesValues) {
  const Scene scene = parseScene(
      block, "test.yaml",
      {"degree=3", "basis=lagrange", "steps[1].count=7", "tools[0].motion.x[2]=1.5", "solver.max_cuts=3",
       "material={law: neo-hookean, E: 5, nu: 0}", "degree=4", "contact[0].parameter=2.5", "title=a = b"});
  EXPECT_EQ(scene.body.degree, 4);
  EXPECT_EQ(scene.body.basis, BasisChoice::Lagrange);
  EXPECT_EQ(scene.steps[0].count, 20);
  EXPECT_EQ(scene.steps[1].count, 7);
  EXPECT_EQ(*scene.tools[0].motion->x, (std::vector<double>{0, 0, 1.5}));
  EXPECT_EQ(scene.solver.stepping.maxCuts, 3);
  EXPECT_EQ(std::get<NeoHookean::Parameters>(scene.body.material).E, 5.0);
  EXPECT_EQ(scene.contact[0].options.parameter, 2.5);
  EXPECT_EQ(scene.title, "a = b");
}

TEST(SceneOverride, reportsItsOwnPlace) {
  const auto expect = [](const std::string& override, const std::string& message) {
    const std::string expected = "--set " + override + ": " + message;
    EXPECT_EQ(errorOf(block, {override}).substr(0, expected.size()), expected);
  };
  const std::string form = "an override reads path=value, such as degree=3 or tools[0].radius=0.5";
  for (const char* text : {"degree", "=3", "[0]=3", "steps[x].count=3", "steps[0]count=3", "a..b=3",
                           "steps[0.count=3", "degree.=3"})
    expect(text, form);
  expect("degree=11", "degree: found 11; allowed: a whole number from 1 to 10.");
  expect("degree=", "degree: found nothing; allowed: a whole number from 1 to 10.");
  expect("degre=3", "degre: found an unknown key; allowed:");
  expect("degree=[1", "degree: malformed YAML: ");
  expect("material={law: neo-hookean, E: 1, nu: 0, E: 2}", "material.E: the key is already given");
  expect("steps[2].count=3",
         "steps[2].count: [2] is looked for in a list of 2 entries; they are counted from 0");
  expect("steps.count=3",
         "steps.count: \"count\" is looked for in a list of 2 entries; a key needs a mapping");
  expect("material[0]=3", "material[0]: [0] is looked for in a mapping; an index needs a list");
  expect("degree.x=3", "degree.x: \"x\" is looked for in 2; a key needs a mapping");
  expect("tools[0].motion={x: [1]}",
         "tools[0].motion.times: missing; required: a list of 1 or more increasing numbers.");
}

TEST(SceneOverride, isReportedAfterTheFile) {
  EXPECT_EQ(errorOf(replaced(block, "nu: 0.3", "nu: 1"), {"title=x", "degree=0"}),
            "test.yaml:4:42: material.nu: found 1; allowed: a number above -1 and below 0.5.\n"
            "--set degree=0: degree: found 0; allowed: a whole number from 1 to 10.");
}

const std::filesystem::path scenes = std::filesystem::path(BURNISH_SOURCE_DIR) / "scenes";

TEST(PaperScenes, suitEveryBasisAndDegree) {
  for (const char* file : {"paper/elastic.yaml", "paper/plastic.yaml"}) {
    for (const char* basis : {"nurbs", "lagrange"}) {
      for (const int degree : {1, 2, 3, 4}) {
        const Scene scene =
            readScene(scenes / file, {std::string("basis=") + basis, "degree=" + std::to_string(degree)});
        EXPECT_EQ(scene.body.degree, degree);
        EXPECT_EQ(scene.body.geometry.mesh.functions, (std::vector<int>{49, 25}));
      }
    }
  }
}

TEST(PaperScenes, holdTheConstantsOfTheStudy) {
  const Scene elastic = readScene(scenes / "paper/elastic.yaml");
  EXPECT_EQ(std::get<NeoHookean::Parameters>(elastic.body.material).E, 1.0);
  EXPECT_EQ(std::get<NeoHookean::Parameters>(elastic.body.material).nu, 0.3);
  const Scene plastic = readScene(scenes / "paper/plastic.yaml");
  const auto& j2 = std::get<J2Plasticity::Parameters>(plastic.body.material);
  EXPECT_EQ(j2.E, 70000.0);
  const auto& voce = std::get<VoceHardening>(j2.hardening);
  EXPECT_EQ(voce.sigma0, 79.66);
  EXPECT_EQ(voce.sigmaInf, 171.26);
  EXPECT_EQ(voce.beta, 17.8);
  for (const Scene& scene : {elastic, plastic}) {
    const auto& cylinder = std::get<Cylinder>(scene.tools.at(0).shape);
    EXPECT_EQ(cylinder.center.given(), (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(cylinder.radius, 0.5);
    EXPECT_EQ(*scene.tools[0].motion->y, (std::vector<double>{0, -0.075, -0.075}));
    EXPECT_EQ(scene.steps.at(0).count, 20);
    EXPECT_EQ(scene.steps.at(1).count, 200);
  }
}

TEST(ExampleScenes, areRead) {
  const auto examples = samples::exampleScenes();
  for (const auto& file : examples) EXPECT_NO_THROW(readScene(file)) << file;
  EXPECT_GE(examples.size(), 3u);
}

TEST(SceneBodies, TakeWhatTheyDoNotSayFromTheScene) {
  const Scene scene = parseScene(samples::twoBodies, "test.yaml", {"quadrature_points=6"});
  ASSERT_EQ(scene.allBodies().size(), 2u);
  const BodySpec &soft = scene.bodies[0], &firm = scene.bodies[1];
  EXPECT_EQ(soft.formulation, Formulation::ProjectedDilatation);
  EXPECT_EQ(firm.formulation, Formulation::Displacement);
  EXPECT_EQ(soft.basis, BasisChoice::Nurbs);
  EXPECT_EQ(firm.basis, BasisChoice::Lagrange);
  EXPECT_EQ(soft.quadraturePoints, 6);
  EXPECT_EQ(firm.quadraturePoints, 5);
  EXPECT_EQ(scene.dim(), 2);
  EXPECT_EQ(scene.bodyNumber("firm"), 1u);
  EXPECT_EQ(scene.bodyKey(1, "geometry"), "bodies[1].geometry");
}

TEST(SceneBodies, NetsKeepTheirDegreeIfNobodyGivesOne) {
  const std::string bodies = R"(bodies:
  - name: net
    geometry: {shape: control-net, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]],
               points: [[0, 0], [1, 0], [0, 1], [1, 1]]}
    material: {law: neo-hookean, E: 1, nu: 0.3}
  - name: block
    geometry: {shape: rectangle, size: [1, 1], spans: [1, 1]}
    material: {law: neo-hookean, E: 1, nu: 0.3}
steps: [{until: 1, count: 1}]
)";
  const Scene scene = parseScene(bodies, "test.yaml");
  EXPECT_EQ(scene.bodies[0].degree, 1);
  EXPECT_EQ(scene.bodies[1].degree, 2);
  EXPECT_EQ(parseScene("degree: 3\n" + bodies, "test.yaml").bodies[0].degree, 3);
}

TEST(SceneBodies, AreWrittenAsTheyAreRead) {
  const Scene scene = parseScene(samples::twoBodies, "test.yaml");
  const Scene again = parseScene(scene.resolvedYaml, "again.yaml");
  EXPECT_EQ(again.resolvedYaml, scene.resolvedYaml);
  EXPECT_EQ(again.bodies.size(), 2u);
  EXPECT_EQ(again.contact[1].place.body, "firm");
  EXPECT_EQ(scene.resolvedYaml.find("\ngeometry:"), std::string::npos);
}

}  // namespace
}  // namespace burnish
