#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>

#include "engine/results/history.h"
#include "tests/cli/shell_test.h"

/// `burnish probe` as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// A quarter of a thick-walled cylinder, whose inner pressure grows to a hundred millionth of its modulus.
constexpr const char* kCylinder = R"(
units: {length: mm, stress: MPa}
degree: 3
geometry: {shape: annulus, inner_radius: 1, outer_radius: 2, spans: [6, 6]}
material: {law: neo-hookean, E: 1, nu: 0.3}
supports: [{face: bottom, symmetry: true}, {face: top, symmetry: true}]
loads: [{face: left, pressure: "1e-8*t"}]
steps: [{until: 1, count: 4}]
output: {every: 0.25, vtu: false}
measures: [{name: p, kind: point, position: [0.9, 1.2], fields: [displacement, von_mises, stress]}]
)";

class ProbeCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    std::ofstream(dir / "scene.yaml") << kCylinder;
    ASSERT_EQ(shell(dir, BURNISH_COMMAND " run scene.yaml -o run --quiet").code, 0);
  }

  Outcome probe(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " probe " + arguments);
  }

  /// The table that a call writes.
  HistoryTable table(const std::string& arguments) const {
    const Outcome outcome = probe(arguments + " -o table.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    return readHistory(dir / "table.csv");
  }

  /// The texts of a chart without numbers.
  std::vector<std::string> chart(const std::string& arguments) const {
    const Outcome outcome = probe(arguments + " -o chart.svg");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string svg = readText(dir / "chart.svg");
    const std::regex text(R"(<text[^>]*>\s*([A-Za-z][^<]*?)\s*</text>)");
    std::vector<std::string> found;
    for (std::sregex_iterator match(svg.begin(), svg.end(), text), end; match != end; ++match)
      found.push_back((*match)[1]);
    return found;
  }

  void expectRefused(const std::string& arguments, const std::string& part) const {
    const Outcome outcome = probe(arguments + " -o out/refused.png");
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, testing::StartsWith("burnish: "));
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(dir / "out")) << arguments;
  }
};

TEST_F(ProbeCommand, MeetsLamesSolutionAlongALine) {
  const HistoryTable found = table("run --line 1,0:2,0 --field stress.xx --field stress.yy --points 21");
  ASSERT_EQ(found.columns, (std::vector<std::string>{"distance [mm]", "x [mm]", "y [mm]", "X [mm]", "Y [mm]",
                                                     "stress.xx [MPa]", "stress.yy [MPa]"}));
  for (std::size_t k = 0; k < found.numRows(); ++k) {
    const double r = found.column("X [mm]")[k];
    if (std::isnan(r)) continue;
    EXPECT_NEAR(found.column("stress.xx [MPa]")[k], 1e-8 / 3.0 * (1.0 - 4.0 / (r * r)), 2e-11) << r;
    EXPECT_NEAR(found.column("stress.yy [MPa]")[k], 1e-8 / 3.0 * (1.0 + 4.0 / (r * r)), 2e-11) << r;
  }
}

TEST_F(ProbeCommand, FollowsAPointAsTheHistoryDoes) {
  const HistoryTable history = readHistory(dir / "run/history.csv"),
                     found = table("run --point 0.9,1.2 --field von_mises --field stress.xy");
  EXPECT_EQ(found.column("time"), history.column("time"));
  for (std::size_t k = 0; k < found.numRows(); ++k) {
    EXPECT_NEAR(found.column("von_mises [MPa]")[k], history.column("p.von_mises")[k], 1e-20);
    EXPECT_NEAR(found.column("stress.xy [MPa]")[k], history.column("p.stress_xy")[k], 1e-20);
    EXPECT_NEAR(found.column("x [mm]")[k], 0.9 + history.column("p.ux")[k], 1e-14);
  }
  EXPECT_EQ(table("run --point 0.9,1.2 --frame 1-2").numRows(), 2U);
}

TEST_F(ProbeCommand, TakesMeansOverTime) {
  // Half of the cylinder is in equilibrium: hoop stress times thickness is pressure times inner radius.
  const HistoryTable found =
      table("run --line 1,0:2,0 --mean --reference --field stress.yy --field stress.xx");
  ASSERT_EQ(found.columns, (std::vector<std::string>{"time", "stress.yy [MPa]", "stress.xx [MPa]"}));
  EXPECT_EQ(found.column("time"), (std::vector{0.0, 0.25, 0.5, 0.75, 1.0}));
  for (std::size_t k = 0; k < found.numRows(); ++k)
    EXPECT_NEAR(found.column("stress.yy [MPa]")[k], 1e-8 * found.column("time")[k], 1e-12);
}

TEST_F(ProbeCommand, SaysInWordsWhatAChartShows) {
  // No legend for a single curve.
  EXPECT_THAT(chart("run --depth left@0.3 --field von_mises --window 0.1"),
              UnorderedElementsAre("Depth below face left [mm]", "von Mises stress, mean over 0.1 mm [MPa]"));
  EXPECT_THAT(chart("run --face left --reference --field stress.xx --field stress.yy"),
              UnorderedElementsAre("Length along face left of the undeformed body [mm]",
                                   "Cauchy stress [MPa]", "Cauchy stress xx", "Cauchy stress yy"));
  EXPECT_THAT(chart("run --point 1,1 --field displacement"),
              UnorderedElementsAre("Time", "Displacement [mm]"));
  EXPECT_THAT(chart("run --point 1,1 --window 0.2 --field displacement"),
              UnorderedElementsAre("Time", "Displacement, mean over 0.2 mm around the point [mm]"));
  EXPECT_THAT(chart("run --face left --mean --field von_mises"),
              UnorderedElementsAre("Time", "von Mises stress, mean along face left [MPa]"));
}

TEST_F(ProbeCommand, DrawsSeveralRunsAndFramesInOneChart) {
  fs::copy(dir / "run", dir / "other", fs::copy_options::recursive);
  EXPECT_THAT(chart("run other --line 1,0:2,0 --field von_mises"),
              UnorderedElementsAre("Distance along the line [mm]", "von Mises stress [MPa]", "run", "other"));
  EXPECT_THAT(chart("run --line 1,0:2,0 --frame 1-2 --field von_mises --label a --label b"),
              UnorderedElementsAre("Distance along the line [mm]", "von Mises stress [MPa]", "a", "b"));
  EXPECT_THAT(table("run other --line 1,0:2,0 --frame 3-4 --field von_mises").columns,
              testing::Contains("other at t = 0.75 von_mises [MPa]"));
}

TEST_F(ProbeCommand, WritesChartsAndTablesAtOnceAndPrintsThem) {
  const Outcome outcome = probe("run --line 1,0:2,0 --points 3 -o new/a.pdf --csv -");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              testing::StartsWith("distance [mm],x [mm],y [mm],X [mm],Y [mm],von_mises [MPa]\n0,"));
  EXPECT_TRUE(fs::exists(dir / "new/a.pdf"));
  EXPECT_EQ(probe("run --line 1,0:2,0 -o a.png --csv b.csv").code, 0);
  EXPECT_TRUE(fs::exists(dir / "a.png") && fs::exists(dir / "b.csv"));
  // What it writes can be drawn again.
  EXPECT_EQ(shell(dir, BURNISH_COMMAND " plot b.csv --x 'distance [mm]' --y 'von_mises [MPa]' -o c.png").code,
            0);
}

constexpr const char* kProbes = R"(probes:
  - {name: radius, line: "1,0:2,0", field: [stress.xx, stress.yy], times: [0.5, 1], points: 11}
  - {name: place, point: "0.9,1.2", field: [von_mises]}
)";

TEST_F(ProbeCommand, ScenesHaveTheSameAtTheEndOfTheirRuns) {
  std::ofstream(dir / "probed.yaml") << kCylinder << kProbes;
  const Outcome run = shell(dir, BURNISH_COMMAND " run probed.yaml -o probed --quiet");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const auto& [name, options] :
       {std::pair{"radius", "--line 1,0:2,0 --field stress.xx --field stress.yy --points 11 --frame 2-4"},
        std::pair{"place", "--point 0.9,1.2 --field von_mises"}}) {
    ASSERT_EQ(probe(std::string("probed ") + options + " -o own.csv").code, 0);
    const HistoryTable ofScene = readHistory(dir / "probed/probes" / (std::string(name) + ".csv")),
                       own = readHistory(dir / "own.csv");
    for (std::size_t column = 0; column < ofScene.columns.size(); ++column)
      EXPECT_THAT(ofScene.values[column],
                  testing::Pointwise(testing::NanSensitiveDoubleEq(), own.column(ofScene.columns[column])))
          << ofScene.columns[column];
    EXPECT_TRUE(readText(dir / "probed/probes" / (std::string(name) + ".png")).starts_with("\x89PNG"));
  }
  ASSERT_EQ(shell(dir, BURNISH_COMMAND " report probed").code, 0);
  const std::string page = readText(dir / "probed/report.html");
  EXPECT_THAT(page, HasSubstr("<h2>Probes</h2>"));
  EXPECT_THAT(page, HasSubstr("Distance along the line [mm]"));
  EXPECT_THAT(readText(dir / "probed/report.html"), testing::Not(HasSubstr("outside of")));
  ASSERT_EQ(shell(dir, BURNISH_COMMAND " report run").code, 0);
  EXPECT_THAT(readText(dir / "run/report.html"), testing::Not(HasSubstr("Probes")));
}

TEST_F(ProbeCommand, ScenesAreToldOfProbesThatCannotBe) {
  const auto refusal = [&](const std::string& text, const std::string& other) {
    std::string probes = kProbes;
    probes.replace(probes.find(text), text.size(), other);
    std::ofstream(dir / "wrong.yaml") << kCylinder << probes;
    const Outcome checked = shell(dir, BURNISH_COMMAND " validate wrong.yaml");
    EXPECT_EQ(checked.code, 2);
    return checked.err;
  };
  EXPECT_THAT(refusal("1,0:2,0", "1,0:2"), HasSubstr("wrong.yaml:12:26: probes[0].line: found \"1,0:2\""));
  EXPECT_THAT(refusal("\"1,0:2,0\"", "\"1,0:2,0\", depth: left@0"),
              HasSubstr("probes[0].line: found line and depth; expected one of"));
  EXPECT_THAT(refusal("line: \"1,0:2,0\"", "depth: inside@0"),
              HasSubstr("probes[0].depth: 'inside' is not a face"));
  EXPECT_THAT(refusal("line: \"1,0:2,0\"", "depth: left@9"),
              HasSubstr("probes[0].depth: found the place 9; expected a length along the face"));
  EXPECT_THAT(refusal("1,0:2,0", "1,0:1,0"), HasSubstr("probes[0].line: found 1,0:1,0, a point twice"));
  EXPECT_THAT(refusal("0.9,1.2", "0.1,0.1"), HasSubstr("probes[1].point: (0.1, 0.1) is "));
  EXPECT_THAT(refusal("[0.5, 1]", "[0.5, 2]"),
              HasSubstr("probes[0].times[1]: found 2; allowed: a time up to"));
  EXPECT_THAT(refusal("[von_mises]", "[von_mises], times: [1]"),
              HasSubstr("probes[1].times: found times of values over time"));
  EXPECT_THAT(refusal("[von_mises]", "[plastic_strain]"),
              HasSubstr("probes[1].field[0]: found plastic_strain"));
  EXPECT_THAT(refusal("name: place", "name: radius"), HasSubstr("found the file name radius a second time"));
  EXPECT_THAT(refusal("[von_mises]", "[von_mises], body: [hub]"), HasSubstr("probes[1].body[0]: found hub"));
}

TEST_F(ProbeCommand, RefusesWhatDoesNotFit) {
  expectRefused("run", "found no place; expected one of line, face, depth and point");
  expectRefused("run --line 1,0:2,0 --face left",
                "line: found beside a face of a plane body, which is a path itself; expected one of the two");
  expectRefused("run --line 1,0", "line: found \"1,0\"; expected X0,Y0:X1,Y1, two points of the plane");
  expectRefused("run --line 1,0:2,x", "line: found \"1,0:2,x\"");
  expectRefused("run --line 1,0:2,", "line: found \"1,0:2,\"");
  expectRefused("run --line 1,0,0:2,0,0", "line: found \"1,0,0:2,0,0\"");
  expectRefused("run --line 5,0:6,0", "line: no point of it is in the deformed body of frame 4, which lies");
  expectRefused("run --point 1", "point: found \"1\"; expected X,Y, a position in the undeformed body");
  expectRefused("run --point 0,0", "point: (0, 0) is 1 outside of the undeformed body");
  expectRefused("run --face inner", "the faces are left, right, bottom, top");
  expectRefused("run --depth left",
                "depth: found \"left\"; expected FACE@X,Y, a position on the face, or FACE@S");
  expectRefused("run --line 1,0:2,0 --length 1",
                "--length: says how deep depth goes; expected depth beside it");
  expectRefused("run --line 1,0:2,0 --patch a", "--patch: names the patch of a face; expected face or depth");
  expectRefused("run --point 1,1 --reference", "--reference: says where a path lies");
  expectRefused("run --point 1,1 --window 500",
                "window: only 0 of the 192 points of the disc of diameter 500");
  expectRefused("run --line 1,0:2,0 --window 1 --mean",
                "--window: says what values along a path or at a point are means of");
  expectRefused("run --point 1,1 --mean", "--mean: is that of a path; expected no point beside it");
  expectRefused("run --line 1,0:2,0 --window 0", "--window: found \"0\"; expected a number above 0");
  expectRefused("run --line 1,0:2,0 --points 1",
                "--points: found \"1\"; expected a whole number from 2 to 1000000");
  expectRefused("run --line 5,0:6,0 --mean",
                "no point of the path is in a body with the field in any of the frames");
  expectRefused("run --line 1,0:2,0 --body a", "body: found \"a\"");
  expectRefused("run --line 1,0:2,0 --frame 9", "--frame: there is no frame 9; the result has frames 0 to 4");
  expectRefused("run --line 1,0:2,0 --field stres.xx", "field: found \"stres.xx\"; available in frame");
  expectRefused("run --line 1,0:2,0 --field stress.xz", "Did you mean \"stress.xx\"?");
  expectRefused("run --line 1,0:2,0 --field stress.yz",
                "field: found \"stress.yz\"; available in frame 4: displacement,");
  expectRefused("run --line 1,0:2,0 --field von_mises --field displacement",
                "von_mises has the unit MPa and displacement the unit mm; expected one unit along an axis");
  expectRefused("run run --line 1,0:2,0 --label a --label b --label c", "--label: found 3 for 2 results");
  expectRefused("nothing --line 1,0:2,0", "nothing: there is no such file or directory");
  EXPECT_EQ(probe("run --line 1,0:2,0").code, 2);
  EXPECT_EQ(probe("run --line 1,0:2,0 -o a.gif").code, 2);
  EXPECT_THAT(probe("run --line 1,0:2,0 -o run/result.h5").err, HasSubstr("expected the name of a chart"));
}

}  // namespace
}  // namespace burnish
