#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <new>
#include <stdexcept>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/faults.h"
#include "cli/jobs/study_plan.h"
#include "cli/progress.h"
#include "cli/usage_error.h"
#include "engine/core/error.h"
#include "engine/scene/reader.h"

namespace burnish {
namespace {

void expectError(const std::function<void()>& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Arguments, FrameIsANumberTheLastOneOrATime) {
  const std::vector<double> times{0.0, 0.1, 0.30000000000000004};
  EXPECT_EQ(frameIndex("0", times), 0);
  EXPECT_EQ(frameIndex("2", times), 2);
  EXPECT_EQ(frameIndex("last", times), 2);
  EXPECT_EQ(frameIndex("time=0.3", times), 2);
  for (const char* text : {"end", "time=end", "time=last"}) EXPECT_EQ(frameIndex(text, times), 2);
  EXPECT_EQ(frameIndices("time=0-time=end", times), (std::vector<int>{0, 1, 2}));
  expectError([&] { frameIndex("3", times); }, "there is no frame 3; the result has frames 0 to 2");
  expectError([&] { frameIndex("-1", times); }, "there is no frame -1");
  expectError([&] { frameIndex("time=0.2", times); }, "the nearest is frame");
  for (const char* text : {"", "1x", "first", "time=", "time=now", "time=nan", "1.5"})
    expectError([&] { frameIndex(text, times); }, "expected a number, last or end, or time=T");
  expectError([] { frameIndex("last", {}); }, "no frames yet");
}

TEST(Arguments, RangeAndSizeArePairs) {
  EXPECT_EQ(rangeFromText("--range", "-1.5,2e3"), (std::array{-1.5, 2000.0}));
  EXPECT_EQ(sizeFromText("640,480"), (std::array{640, 480}));
  for (const char* text : {"", "1", "1,", ",1", "1;2", "2,1", "1,1", "0,nan", "0,1,2", "0, 1"})
    expectError([=] { rangeFromText("--range", text); }, "expected LO,HI");
  for (const char* text :
       {"640x480", "160,480", "640,149", "640.5,480", "640,0", "-640,480", "99999,480", "99999999999,480"})
    expectError([=] { sizeFromText(text); }, "expected W,H");
}

TEST(Progress, LineFitsATerminal) {
  EXPECT_EQ(durationText(59.4), "0:59");
  EXPECT_EQ(durationText(59.6), "1:00");
  EXPECT_EQ(durationText(3723.0), "1:02:03");
  const RunProgress progress{.step = 120, .time = 0.5, .endTime = 2.0, .iterations = 4, .totalCuts = 3};
  EXPECT_EQ(progressLine(progress, 15.0),
            "step 120  t 0.5 of 2  iterations 4  cut-backs 3  0:15 of about 1:00");
  const RunProgress longest{
      .step = 123456, .time = 1.23456, .endTime = 2.34567, .iterations = 250, .totalCuts = 12345};
  EXPECT_LT(progressLine(longest, 86399.0).size(), 100u);
}

TEST(ExitCodes, AFaultOfTheProgramHasItsOwn) {
  const auto codeOf = [](const auto& thrown) {
    return static_cast<int>(guarded([&]() -> ExitCode { throw thrown; }));
  };
  EXPECT_EQ(codeOf(std::logic_error("a row of 2 values for 3 columns")), 70);
  EXPECT_EQ(codeOf(Error("no such file")), 2);
  EXPECT_EQ(codeOf(std::bad_alloc()), 2);
  EXPECT_EQ(static_cast<int>(guarded([] { return ExitCode::ChecksFail; })), 1);
}

/// Parses a command line that must fail and returns the message.
std::string usage(const std::string& commandLine) {
  CLI::App app("", "burnish");
  app.require_subcommand(1);
  Action action;
  addRunCommand(app, action);
  addRenderCommand(app, action);
  addExportCommand(app, action);
  addInfoCommand(app, action);
  try {
    app.parse(commandLine);
  } catch (const CLI::ParseError& error) {
    return usageMessage(app, error);
  }
  return "";
}

TEST(Usage, AnswersWithTheNearestValidWord) {
  EXPECT_EQ(usage("rnder out"),
            "there is no command rnder. Did you mean \"render\"? \"burnish --help\" explains");
  EXPECT_EQ(usage("run --treads 2 a.yaml"),
            "there is no option --treads. Did you mean \"--threads\"? \"burnish run --help\" explains");
  EXPECT_EQ(usage("render --feild=pressure out -o a.png"),
            "there is no option --feild. Did you mean \"--field\"? \"burnish render --help\" explains");
  EXPECT_EQ(usage("info a b"), "burnish info does not expect \"b\"; \"burnish info --help\" explains");
  EXPECT_NE(usage("").find("a command is needed: run, render, export, info"), std::string::npos);
  EXPECT_NE(usage("render out").find("--output is required"), std::string::npos);
}

TEST(Usage, TakesOneValuePerSetAndNegativeRanges) {
  EXPECT_EQ(usage("run --set degree=3 --set basis=lagrange a.yaml"), "");
  EXPECT_EQ(usage("run --set degree=3 a.yaml"), "");
  EXPECT_EQ(usage("render out --range -1,1 -o a.png"), "");
}

TEST(ExpectedCost, GrowsWithTheFunctionsOfAllPatches) {
  const auto cost = [](const std::string& geometry) {
    return expectedCost(
        parseScene("degree: 2\nmaterial: {law: neo-hookean, E: 1, nu: 0.3}\n"
                   "supports: [{patch: a, face: left, fix: [x, y]}]\n"
                   "steps: [{until: 1, count: 3}]\ngeometry: {shape: patches, patches: [" +
                       geometry + "]}\n",
                   "test"));
  };
  const std::string a = "{name: a, shape: rectangle, size: [1, 1], spans: [4, 2]}";
  EXPECT_DOUBLE_EQ(cost(a + ", {name: b, shape: annulus, center: [9, 9], inner_radius: 1, outer_radius: 2, "
                            "functions: [5, 7]}"),
                   2.0 * std::pow(6 * 4 + 5 * 7, 1.5) * 4 * 3);
  EXPECT_DOUBLE_EQ(cost(a + ", {name: b, shape: control-net, degrees: [1, 1], knots: [[0, 0, 0.5, 1, 1], "
                            "[0, 0, 1, 1]], points: [[1, 0], [2, 0], [3, 0], [1, 1], [2, 1], [3, 1]], "
                            "refine: [2, 2]}"),
                   2.0 * std::pow(6 * 4 + 7 * 4, 1.5) * 4 * 3);
}

}  // namespace
}  // namespace burnish
