#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "postproc/text/text_file.h"
#include "tests/cli/shell_test.h"

/// What `burnish figures --workflow` writes; tests/workflow has it worked off. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kBlock = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [6, 4]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: line, shape: polyline, file: ../lines/line.txt, motion: {times: [0, 1], y: [0, -0.01]}}]
contact: [{tool: line, face: top}]
steps: [{until: 1, count: 2}]
)";

constexpr const char* kBlocks = R"(
runs:
  - {name: "b-{degree}", scene: ./scenes/block.yaml, vary: [{name: degree, values: [3, 2]}], set: ["degree={degree}"]}
  - {name: other, scene: scenes/block.yaml, set: ['title=a\b "c" {x, y}', "tools[0].file=../lines/other.txt", degree=1]}
figures:
  - {name: energy, kind: history, runs: ["b-*"], y: strain_energy, reference: points.csv}
  - {name: all, kind: composite, figures: [energy]}
)";

class WorkflowCommand : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    for (const char* line : {"lines/line.txt", "lines/other.txt"})
      writeText("0 1.2\n1 1.1\n2 1.2\n", dir / line);
    writeText("x,y\n0,0\n1,1\n", dir / "points.csv");
    writeText(kBlock, dir / "scenes/block.yaml");
    writeText(kBlocks, dir / "study.yaml");
  }

  Outcome figures(const std::string& arguments) const {
    return shell(dir, BURNISH_COMMAND " figures " + arguments);
  }

  /// Expects that a command is refused in one line with these words.
  void expectRefusal(const std::string& arguments, const std::string& words) const {
    const Outcome outcome = figures(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
};

TEST_F(WorkflowCommand, SaysWhatRunsAndFiguresAreMadeOf) {
  const Outcome outcome = figures("./study.yaml --workflow snakemake");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "workflow Snakefile: 3 runs, 2 figures and a document; start it with: snakemake -c2\n");
  EXPECT_FALSE(fs::exists(dir / "out")) << "nothing is computed";

  const std::string text = readText(dir / "Snakefile");
  EXPECT_THAT(text, HasSubstr("\nSTUDY = \"study.yaml\"\n"));
  EXPECT_THAT(
      text,
      HasSubstr("\nRESULTS = config.get(\"results\", \"out/study\")\nDOCUMENT = RESULTS + \"/study.md\"\n"));
  EXPECT_THAT(text,
              HasSubstr("config.get(\"burnish\", \"" + fs::canonical(BURNISH_COMMAND).string() + "\")"));
  EXPECT_THAT(
      text,
      HasSubstr(
          R"(
RUNS = {
    "b-3": {"files": ["scenes/block.yaml", "scenes/../lines/line.txt"], "set": ["degree=3"], "priority": 2},
    "b-2": {"files": ["scenes/block.yaml", "scenes/../lines/line.txt"], "set": ["degree=2"], "priority": 1},
    "other": {"files": ["scenes/block.yaml", "scenes/../lines/other.txt"], )"
          R"("set": ["title=a\\b \"c\" {x, y}", "tools[0].file=../lines/other.txt", "degree=1"], "priority": 0},
}
)"));
  EXPECT_THAT(text, HasSubstr(R"(
FIGURES = {
    "energy": {"runs": ["b-3", "b-2"], "parts": [], "files": ["points.csv"]},
    "all": {"runs": ["b-3", "b-2"], "parts": ["energy"], "files": []},
}
)"));
}

TEST_F(WorkflowCommand, GoesWhereItIsWanted) {
  const Outcome outcome = figures(
      "study.yaml --workflow snakemake -o 'a b/work' --results 'out of it' --document docs/d.md --gallery docs/pictures");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("start it with: snakemake -s 'a b/work' -c2\n"));
  const std::string text = readText(dir / "a b/work");
  EXPECT_THAT(text, HasSubstr("# Written by: burnish figures study.yaml --workflow snakemake -o 'a b/work' "
                              "--results 'out of it' --document docs/d.md --gallery docs/pictures\n"));
  EXPECT_THAT(text, HasSubstr("config.get(\"results\", \"out of it\")"));
  EXPECT_THAT(text, HasSubstr("\nDOCUMENT = \"docs/d.md\"\nGALLERY = [\"--gallery\", \"docs/pictures\"]\n"));
}

TEST_F(WorkflowCommand, WritesOverWorkflowsAlone) {
  writeText("# mine\n", dir / "Snakefile");
  expectRefusal("study.yaml --workflow snakemake",
                "-o: Snakefile is there and no workflow that burnish wrote");
  EXPECT_EQ(readText(dir / "Snakefile"), "# mine\n");
  expectRefusal("study.yaml --workflow snakemake -o scenes", "-o: scenes is there");
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(figures("study.yaml --workflow snakemake -o twice").code, 0) << "the one that it wrote before";
}

TEST_F(WorkflowCommand, RefusesWhatCannotBeAWorkflow) {
  expectRefusal("study.yaml --workflow snakmake",
                "--workflow: found \"snakmake\"; expected snakemake. Did you mean \"snakemake\"?");
  expectRefusal("study.yaml --workflow snakemake -o points.csv/Snakefile", "points.csv");
  expectRefusal("study.yaml --workflow snakemake --document study.yaml",
                "--document: study.yaml is also read");
  expectRefusal("study.yaml --workflow snakemake --jobs 2", "--jobs");
  expectRefusal("study.yaml --results out", "--workflow");
  fs::copy(dir / "study.yaml", dir / "{name}.yaml");
  expectRefusal("'{name}.yaml' --workflow snakemake", "{name}: found a brace");
  writeText("runs: []\n", dir / "none.yaml");
  expectRefusal("none.yaml --workflow snakemake", "none.yaml:1:");
  EXPECT_FALSE(fs::exists(dir / "Snakefile"));
}

TEST_F(WorkflowCommand, AFigureIsDrawnInPlaceOfTheOneBefore) {
  ASSERT_EQ(figures("study.yaml -o out --only energy").code, 0);
  const std::string record = readText(dir / "out/drawn/energy.txt");
  writeText("of an earlier study", dir / "out/figures/energy_2.png");
  writeText(record + "figures/energy_2.png\n", dir / "out/drawn/energy.txt");
  fs::remove(dir / "out/figures/energy.png");  // as Snakemake does
  ASSERT_EQ(figures("study.yaml -o out --only energy --draw-only").code, 0);
  EXPECT_FALSE(fs::exists(dir / "out/figures/energy_2.png"));
  EXPECT_EQ(readText(dir / "out/drawn/energy.txt"), record);
}

}  // namespace
}  // namespace burnish
