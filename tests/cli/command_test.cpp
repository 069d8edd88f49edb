#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "tests/cli/shell_test.h"

/// The program as the user meets it: exit codes, messages, and what is left behind. BURNISH_COMMAND is its
/// path.
namespace burnish {
namespace {

namespace fs = std::filesystem;

/// A block under a disc that goes down and up again.
constexpr const char* kScene = R"(
title: Small press
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools:
  - {name: disc, shape: cylinder, center: [1.0, 1.5], radius: 0.5, motion: {times: [0, 1, 2], y: [0, -0.05, 0]}}
contact: [{tool: disc, face: top}]
steps: [{until: 2, count: 8}]
output: {every: 0.5, vtu: false}
)";

class Command : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    write("scene.yaml", kScene);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(dir / name) << text; }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(dir / name).rdbuf();
    return text.str();
  }

  Outcome burnish(const std::string& arguments) const { return shell(dir, BURNISH_COMMAND " " + arguments); }

  /// Exit code 2, one message that contains `part`, and no output directory.
  void expectRefused(const std::string& arguments, const std::string& part) const {
    const Outcome outcome = burnish(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("burnish: ")) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_FALSE(fs::exists(dir / "out")) << arguments;
  }
};

TEST_F(Command, RunsASceneAndTellsWhatIsInIt) {
  const Outcome run = burnish("run scene.yaml -o out");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("step 1  t 0.25 of 2"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("completed in"), std::string::npos) << run.out;
  EXPECT_EQ(ResultReader(dir / "out").times(), (std::vector<double>{0.0, 0.5, 1.0, 1.5, 2.0}));
  const HistoryTable history = readHistory(dir / "out/history.csv");
  EXPECT_EQ(history.numRows(), 9u);
  EXPECT_EQ(history.column("disc.uy")[4], -0.05);

  const Outcome info = burnish("info out/result.h5");
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_NE(info.out.find("disc: cylinder of radius 0.5"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("5, t = 0 to 2"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("has come to its end"), std::string::npos) << info.out;
  EXPECT_NE(run.out.find("support1              force of the body on face bottom: (0, "), std::string::npos)
      << run.out;
  EXPECT_NE(info.out.find("support1: force of the body on face bottom: (0, "), std::string::npos) << info.out;

  write("out/summary.yaml", "program: [");
  const Outcome damaged = burnish("info out");
  EXPECT_EQ(damaged.code, 0) << damaged.err;
  EXPECT_NE(damaged.out.find("5, t = 0 to 2"), std::string::npos) << damaged.out;
  EXPECT_NE(damaged.out.find("cannot be read as the summary of a run"), std::string::npos) << damaged.out;
}

TEST_F(Command, WarnsOfLockingBeforeAndAfterARun) {
  const std::string warning =
      "material.nu: 0.4999 is nearly incompressible: the displacement formulation of degree 2 locks";
  const Outcome validated = burnish("validate scene.yaml --set material.nu=0.4999");
  EXPECT_EQ(validated.code, 0);
  EXPECT_NE(validated.err.find(warning), std::string::npos) << validated.err;
  const Outcome run = burnish("run --quiet scene.yaml -o out --set material.nu=0.4999");
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find(warning), std::string::npos) << run.err;
  EXPECT_NE(read("out/summary.yaml").find(warning), std::string::npos);
  EXPECT_NE(burnish("info out").out.find(warning), std::string::npos);
  const Outcome projected =
      burnish("run --quiet scene.yaml -o out --set material.nu=0.4999 --set formulation=fbar");
  EXPECT_EQ(projected.err.find("incompressible"), std::string::npos) << projected.err;
}

TEST_F(Command, TellsWhenAToolIsTakenAway) {
  const Outcome run = burnish("run --quiet scene.yaml -o out --set 'tools[0].until=1.5'");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(burnish("info out").out.find("disc: cylinder of radius 0.5, until t = 1.5"), std::string::npos);
  EXPECT_NE(burnish("info --json out").out.find("\"until\":1.5"), std::string::npos)
      << burnish("info --json out").out;
}

TEST_F(Command, NamesToolsThatNeverTouchWhereverARunIsToldOf) {
  const std::string warning = "tool 'disc' has never touched the body";
  const Outcome run = burnish("run --quiet scene.yaml -o out --set 'tools[0].center=[1, 1.8]'");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find(warning), std::string::npos) << run.err;
  EXPECT_NE(read("out/summary.yaml").find("idle_tools:\n  - disc\n"), std::string::npos);
  EXPECT_NE(burnish("info out").out.find(warning), std::string::npos);
}

TEST_F(Command, MarksPicturesOfADoubtfulRunAndTellsTheSmallestStress) {
  const std::string pictures =
      " --set output.every=1 --set tools[0].motion.y=[0,-0.2,-0.2] --set pictures='[{field: von_mises, "
      "size: [400, 300]}, {field: von_mises, name: "
      "early, times: [1], size: [400, 300]}]'";
  const Outcome run = burnish("run --quiet scene.yaml -o marked" + pictures);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("penetration"), std::string::npos) << "the run has a doubt:" << run.err;
  EXPECT_NE(read("marked/summary.yaml").find("\nvon_mises_minimum: -"), std::string::npos);
  ASSERT_EQ(burnish("run --quiet scene.yaml -o unmarked --no-doubts" + pictures).code, 0);
  ASSERT_EQ(burnish("run --quiet scene.yaml -o own" + pictures + " --set pictures[0].doubt_marks=false").code,
            0);
  for (const char* name : {"pictures/von_mises.png", "pictures/early_t1.png"}) {
    EXPECT_NE(read(std::string("marked/") + name), read(std::string("unmarked/") + name)) << name;
    EXPECT_FALSE(read(std::string("unmarked/") + name).empty()) << name;
  }
  EXPECT_EQ(read("own/pictures/von_mises.png"), read("unmarked/pictures/von_mises.png"));
  EXPECT_EQ(read("own/pictures/early_t1.png"), read("marked/pictures/early_t1.png"));
}

/// The disc has gone up again at the end, where stresses are rounding.
TEST_F(Command, PicturesOfSeveralTimesShareWindowAndColours) {
  const Outcome run = burnish(
      "run scene.yaml -o out --set pictures='[{field: von_mises, times: [0.5, 1, 2], size: [400, 300]}]'");
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_EQ(burnish("render out --field von_mises --frame time=0.5,time=1,time=2 --size 400,300 -o "
                    "'together_t{time}.png'")
                .code,
            0);
  for (const char* time : {"0.5", "1", "2"}) {
    const std::string picture = fmt::format("out/pictures/von_mises_t{}.png", time);
    EXPECT_FALSE(read(picture).empty()) << time;
    EXPECT_EQ(read(picture), read(fmt::format("together_t{}.png", time))) << time;
    const std::size_t told = run.out.find(picture);
    ASSERT_NE(told, std::string::npos) << run.out;
    EXPECT_EQ(run.out.find(picture, told + 1), std::string::npos) << run.out;
  }
  ASSERT_EQ(burnish("render out --field von_mises --frame time=1 --size 400,300 -o alone.png").code, 0);
  EXPECT_NE(read("alone.png"), read("out/pictures/von_mises_t0.5.png"));
}

TEST_F(Command, DescribesASceneSoThatItCanBeRunAgain) {
  const Outcome info = burnish("info scene.yaml");
  ASSERT_EQ(info.code, 0) << info.err;
  write("again.yaml", info.out);
  EXPECT_EQ(burnish("run --quiet scene.yaml -o a").code, 0);
  EXPECT_EQ(burnish("run --quiet again.yaml -o b").code, 0);
  EXPECT_EQ(read("a/history.csv"), read("b/history.csv"));
}

TEST_F(Command, QuietPrintsNothingWhenAllIsWell) {
  // Fine enough for the small depth that the penetration between control points is small too.
  const Outcome run =
      burnish("run --quiet scene.yaml --set tools[0].motion.y=[0,-0.004,0] --set geometry.functions=[40,8]");
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out + run.err, "");
  EXPECT_TRUE(fs::exists(dir / "out/scene/result.h5"));
}

TEST_F(Command, ARunThatStopsExitsWith3AndKeepsItsResults) {
  const Outcome run = burnish(
      "run scene.yaml -o out --set tools[0].motion.y=[0,-0.9,0] --set solver.max_iterations=2 --set "
      "solver.max_cuts=0");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("the run did not reach its end"), std::string::npos) << run.err;
  EXPECT_GE(ResultReader(dir / "out").numFrames(), 1);
  EXPECT_NE(burnish("info out").out.find("run         stopped at t = "), std::string::npos);
}

TEST_F(Command, ValidateTellsWhatRunsWillTake) {
  const Outcome scene = burnish("validate scene.yaml");
  EXPECT_EQ(scene.code, 0);
  EXPECT_THAT(scene.out,
              testing::MatchesRegex(
                  "scene.yaml: fine [(].*[)]\n  takes about [0-9]+ MB, and on one core [0-9.]+ ms per "
                  "Newton iteration .*; [0-9]+ steps of some [0-9] iterations: .*\n"));
  write("study.yaml", "runs:\n  - {name: one, scene: scene.yaml}\n  - {name: two, scene: scene.yaml}\n");
  const Outcome study = burnish("validate study.yaml");
  EXPECT_THAT(study.out, testing::HasSubstr("(a study of 2 runs and 0 figures)\n  its runs take about "));
}

TEST_F(Command, ValidatesTheModelsOfAllRunsOfAStudy) {
  write("study.yaml",
        "runs:\n"
        "  - {name: one, scene: scene.yaml}\n"
        "  - {name: two, scene: scene.yaml, set: [\"tools[0].center=[0.5, 1.4]\"]}\n"
        "  - {name: three, scene: scene.yaml, set: [\"supports=[{face: bottom, fix: [y]}]\"]}\n");
  const Outcome outcome = burnish("validate study.yaml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("study.yaml: run \"two\": "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("overlaps"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("study.yaml: run \"three\": --set supports"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("\"one\""), std::string::npos) << outcome.err;
}

TEST_F(Command, BadInputIsOneMessageAndLeavesNothingBehind) {
  write("broken.yaml", "title: [");
  write("file", "");
  expectRefused("run missing.yaml -o out", "missing.yaml");
  expectRefused("run broken.yaml -o out", "broken.yaml:1:");
  expectRefused("run scene.yaml -o out --set degrees=2", "Did you mean \"degree\"?");
  expectRefused("run scene.yaml -o out --set material.nu=0.5", "material.nu");
  expectRefused("run scene.yaml -o out --set tools[0].center[1]=1.4", "disc");
  expectRefused("run scene.yaml -o file/out", "file/out");
  expectRefused("run scene.yaml -o out --thread 2", "Did you mean \"--threads\"?");
  expectRefused("render nowhere -o a.png", "nowhere");
  expectRefused("info file.h5", "file.h5");
}

TEST_F(Command, ValidateAndRunRefuseTheSameBeforeAnythingIsComputed) {
  const std::vector<std::pair<std::string, std::string>> mistakes{
      {"pictures: [{field: von_mises, mirror: x=0.3}]",
       "bad.yaml:11:39: pictures[0].mirror: found the plane x = 0.3; the undeformed body goes from"},
      {"loads: [{face: left, pressure: 1/(t - 0.5)}]", "bad.yaml:11:32: loads[0].pressure: the formula"},
      {"checks: [{name: a, quantity: disc.fyy, expect: range, at_least: 0}]",
       "bad.yaml:11:30: checks[0].quantity: found disc.fyy, which is no column of the history"},
  };
  for (const auto& [more, message] : mistakes) {
    write("bad.yaml", kScene + more + "\n");
    const Outcome validated = burnish("validate bad.yaml");
    EXPECT_EQ(validated.code, 2) << more;
    EXPECT_TRUE(validated.err.starts_with(message)) << validated.err;
    expectRefused("run bad.yaml -o out", message);
  }
  write("bad.yaml",
        "geometry: {shape: box, size: [1, 1, 1], spans: [1, 1, 1]}\n"
        "material: {law: neo-hookean, E: 1, nu: 0.3}\n"
        "supports: [{face: bottom, fix: [x, y, z]}]\n"
        "steps: [{until: 1, count: 1}]\n"
        "pictures: [{field: von_mises, slice: z=3}, {field: pressure, cut: x=-1}]\n");
  for (const char* command : {"validate bad.yaml", "run bad.yaml -o out"}) {
    const Outcome outcome = burnish(command);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_NE(outcome.err.find("bad.yaml:5:38: pictures[0].slice: its plane misses the body"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("\nbad.yaml:5:67: pictures[1].cut: its plane misses the body"),
              std::string::npos)
        << outcome.err;
  }
}

TEST_F(Command, ControlNetsWithImpossibleKnotsOrWeightsAreRefused) {
  const std::string net =
      "geometry: {shape: control-net, degrees: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], "
      "points: [[0, 0], [2, 0], [0, 1], [2, 1]], weights: [1, 1, 1, 1]}";
  const std::string text = kScene;
  const std::size_t begin = text.find("geometry"), end = text.find('\n', begin);
  write("net.yaml", text.substr(0, begin) + net + "\ndegree: 1" + text.substr(end));
  EXPECT_EQ(burnish("run --quiet net.yaml -o a").code, 0) << read("stderr.txt");
  expectRefused("run net.yaml -o out --set geometry.weights[2]=-1", "weight");
  expectRefused("run net.yaml -o out --set geometry.knots[0]=[0,0,1,0.5]", "knot");
}

TEST_F(Command, VersionAndHelpAreFine) {
  EXPECT_TRUE(burnish("--version").out.starts_with("burnish "));
  EXPECT_EQ(burnish("--help").code, 0);
  EXPECT_EQ(burnish("render --help").code, 0);
}

}  // namespace
}  // namespace burnish
