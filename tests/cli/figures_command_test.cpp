#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <thread>

#include "engine/core/fingerprint.h"
#include "engine/results/summary_file.h"
#include "tests/cli/shell_test.h"

/// `burnish figures` as the user meets it. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kStudiedScene = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [6, 3]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}, {face: top, move: {times: [0, 1], y: [0, -0.1]}}]
steps: [{until: 1, count: 2}]
output: {vtu: false}
)";

/// Two runs of a block, one of them with a change, and a figure of each.
constexpr const char* kStudy = R"(title: Blocks
runs:
  - {name: "block-{degree}", scene: block.yaml, vary: [{name: degree, values: [1, 2]}], set: ["degree={degree}"]}
  - {name: stiff, scene: block.yaml, set: ["STIFF"]}
figures:
  - {name: energy, kind: history, runs: ["block-*"], y: strain_energy}
  - {name: stress, kind: history, runs: [stiff], y: strain_energy}
)";

class FiguresCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    write("block.yaml", kStudiedScene);
    writeStudy("material.E=2");
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(dir / name) << text; }

  void writeStudy(const std::string& change) const {
    std::string text = kStudy;
    write("study.yaml", text.replace(text.find("STIFF"), 5, change));
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(dir / name).rdbuf();
    return text.str();
  }

  Outcome figures(const std::string& arguments = "") const {
    return shell(dir, BURNISH_COMMAND " figures study.yaml -o out " + arguments);
  }

  fs::file_time_type timeOf(const std::string& run) const {
    return fs::last_write_time(dir / "out/runs" / run / "summary.yaml");
  }
};

TEST_F(FiguresCommand, ComputesAndDrawsEverythingOnce) {
  const Outcome first = figures();
  ASSERT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("runs: 3, of which to compute: 3; figures: 2, of which to draw: 2\n"));
  EXPECT_THAT(first.out, HasSubstr("s, 2 steps, "));
  for (const char* name : {"energy", "stress"})
    EXPECT_TRUE(fs::exists(dir / "out/figures" / (std::string(name) + ".png"))) << name;
  EXPECT_TRUE(fs::exists(dir / "out/study.md"));
  EXPECT_THAT(read("out/runs.csv"), HasSubstr("\nblock-2,completed,1,2,0,0.5,"));

  const auto before = timeOf("stiff");
  const Outcome second = figures();
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("runs: 3, of which to compute: 0; figures: 2, of which to draw: 0\n"));
  EXPECT_EQ(timeOf("stiff"), before);
}

TEST_F(FiguresCommand, TellsStudiesApartByADigestThatEveryCompilerMakes) {
  ASSERT_EQ(figures("--only stress").code, 0);
  const std::string study = read("study.yaml"), record = read("out/drawn/stress.txt");
  Fingerprint digest;
  digest.add(std::as_bytes(std::span(study)));
  EXPECT_THAT(record, testing::StartsWith("study " + digest.text() + "\n"));

  write("out/drawn/stress.txt", "study 0123456789abcdef" + record.substr(record.find('\n')));
  EXPECT_THAT(figures("--only stress").out, HasSubstr("to compute: 0; figures: 1, of which to draw: 1\n"))
      << "another program has drawn it";
  EXPECT_EQ(read("out/drawn/stress.txt"), record);
}

TEST_F(FiguresCommand, ComputesOnlyWhatHasChanged) {
  ASSERT_EQ(figures().code, 0);
  const auto before = timeOf("block-1");
  writeStudy("material.E=3");
  const Outcome changed = figures();
  EXPECT_EQ(changed.code, 0) << changed.err;
  EXPECT_THAT(changed.out, HasSubstr("runs: 3, of which to compute: 1;"));
  EXPECT_EQ(timeOf("block-1"), before);

  fs::remove(dir / "out/runs/block-2/summary.yaml");  // as if it had been interrupted
  fs::remove(dir / "out/figures/stress.png");
  EXPECT_THAT(figures().out, HasSubstr("runs: 3, of which to compute: 1; figures: 2, of which to draw: 2\n"));
}

TEST_F(FiguresCommand, AFailureDoesNotStopTheOthers) {
  writeStudy("supports=[]");  // a body that can move away is found out only when it is computed
  const Outcome outcome = figures();
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.out, HasSubstr("stiff: failed (exit code 2); out/runs/stiff/log.txt ends with\n"));
  EXPECT_THAT(outcome.out, HasSubstr("figure stress: skipped, because stiff failed\n"));
  EXPECT_THAT(read("out/runs.csv"), HasSubstr("\nstiff,failed,,"));
  EXPECT_TRUE(fs::exists(dir / "out/figures/energy.png"));
  EXPECT_FALSE(fs::exists(dir / "out/figures/stress.png"));
  EXPECT_TRUE(readSummary(dir / "out/runs/block-2").completed);
}

TEST_F(FiguresCommand, ARunThatStopsEarlyIsAResult) {
  writeStudy("supports[1].move.y=[0,-5]");
  const Outcome outcome = figures();
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("; warning: stopped at t = "));
  EXPECT_THAT(read("out/runs.csv"), HasSubstr("\nstiff,stopped,"));
  EXPECT_THAT(figures().out, HasSubstr("runs: 3, of which to compute: 0"));
}

TEST_F(FiguresCommand, OnlyMakesAFigureAndItsRuns) {
  const Outcome outcome = figures("--only stress --jobs 1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("runs: 1, of which to compute: 1; figures: 1, of which to draw: 1\n"));
  EXPECT_FALSE(fs::exists(dir / "out/runs/block-1"));
  EXPECT_FALSE(fs::exists(dir / "out/figures/energy.png"));
  EXPECT_FALSE(fs::exists(dir / "out/study.md"));

  const Outcome unknown = figures("--only stres");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("has no figure stres; its figures are energy, stress. Did you mean"));
}

TEST_F(FiguresCommand, WhatResultsWillNotHaveIsToldBeforeAnythingIsComputed) {
  writeStudy("material.E=2");
  write("study.yaml", read("study.yaml") +
                          "  - {name: map, kind: sheet, runs: [stiff], times: [0.7], field: plastic_strain}\n"
                          "  - {name: wrong, kind: history, runs: [stiff], y: strain_enery}\n");
  const std::string told =
      "study.yaml:8:53: figures[2].times[0]: found 0.7, but the run stiff has no frame at that time, the nearest ones "
      "are at 0 and 1;";
  for (const std::string command :
       {"figures study.yaml -o out", "validate study.yaml", "figures study.yaml --workflow snakemake"}) {
    const Outcome outcome = shell(dir, BURNISH_COMMAND " " + command);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr(told)) << command;
    EXPECT_THAT(outcome.err,
                HasSubstr("study.yaml:8:66: figures[2].field: run stiff: found plastic_strain, but the "
                          "material is elastic;"))
        << command;
    EXPECT_THAT(outcome.err,
                HasSubstr("study.yaml:9:52: figures[3].y: run stiff: formula \"strain_enery\", character 1: "
                          "there is no column \"strain_enery\". Did you mean \"strain_energy\"?"))
        << command;
  }
  EXPECT_FALSE(fs::exists(dir / "out/runs"));
  EXPECT_FALSE(fs::exists(dir / "Snakefile"));
  EXPECT_EQ(figures("--only energy").code, 0) << "the runs of the others are not looked at";
  EXPECT_THAT(figures("--only wrong").err, HasSubstr("figures[3].y: run stiff: formula"));
}

TEST_F(FiguresCommand, DocumentAndGalleryGoWhereTheyAreWanted) {
  const Outcome outcome = figures("--document docs/blocks.md --gallery docs/pictures");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(read("docs/blocks.md"), HasSubstr("Blocks"));
  EXPECT_FALSE(fs::exists(dir / "out/study.md"));
}

TEST_F(FiguresCommand, EndsItsRunsWhenItIsToldAndResumesThem) {
  writeStudy("steps[0].count=12000");
  const std::string study = (dir / "study.yaml").string(), out = (dir / "out").string();
  const char* const arguments[] = {BURNISH_COMMAND, "figures", study.c_str(), "-o",
                                   out.c_str(),     "--jobs",  "1",           nullptr};
  pid_t process = 0;
  ASSERT_EQ(posix_spawn(&process, BURNISH_COMMAND, nullptr, nullptr, const_cast<char**>(arguments), environ),
            0);
  for (int i = 0; i < 1000 && !fs::exists(dir / "out/runs/stiff/result/frame_000000.h5"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_THAT(figures().err, HasSubstr("another burnish is at work in out"));
  ::kill(process, SIGTERM);
  int status = 0;
  ASSERT_EQ(::waitpid(process, &status, 0), process);
  EXPECT_EQ(WEXITSTATUS(status), 143);

  EXPECT_FALSE(fs::exists(dir / "out/runs/stiff/summary.yaml"));
  const auto begun = fs::last_write_time(dir / "out/runs/stiff/result.h5");
  EXPECT_EQ(figures().code, 0) << "nothing holds the directory any more";
  EXPECT_TRUE(fs::exists(dir / "out/runs/stiff/summary.yaml"));
  EXPECT_EQ(fs::last_write_time(dir / "out/runs/stiff/result.h5"), begun) << "it was computed from its start";
}

}  // namespace
}  // namespace burnish
