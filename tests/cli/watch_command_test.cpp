#include <json/reader.h>
#include <json/value.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/watch/text_chart.h"
#include "engine/results/summary_file.h"
#include "tests/cli/shell_test.h"

/// Runs that are followed from outside. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class Watch : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    std::ofstream(dir / "scene.yaml") << R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
tools: [{name: disc, shape: cylinder, center: [1.0, 1.5], radius: 0.5, motion: {times: [0, 1], y: [0, -0.05]}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 100}]
output: {every: 0.25, vtu: false}
pictures: [{field: von_mises, times: [1], size: [400, 300]}]
)";
  }

  Outcome line(const std::string& text) const {
    return shell(dir, "burnish() { \"" BURNISH_COMMAND "\" \"$@\"; }; " + text);
  }
  Outcome burnish(const std::string& arguments) const { return line("burnish " + arguments); }
};

TEST_F(Watch, FollowsARunToItsEndAndCallsForEveryFrame) {
  const Outcome watched = line(
      "(sleep 1; burnish run scene.yaml -o out --quiet) & burnish watch out --wait --page page.html --on-frame "
      "'echo \"$BURNISH_RESULT $BURNISH_FRAME $BURNISH_TIME\" >>frames.txt'; code=$?; wait; exit $code");
  EXPECT_EQ(watched.code, 0) << watched.err;
  EXPECT_THAT(watched.out, AllOf(HasSubstr("step 100  t 1 of 1  residual "), HasSubstr("frames 5\n"),
                                 HasSubstr("picture out/pictures/von_mises_t1.png\n")));
  EXPECT_EQ(readText(dir / "frames.txt"), "out 0 0\nout 1 0.25\nout 2 0.5\nout 3 0.75\nout 4 1\n");
  const std::string page = readText(dir / "page.html");
  EXPECT_THAT(page, AllOf(HasSubstr("The run has come to its end."), HasSubstr("data:image/png;base64,"),
                          HasSubstr("data:image/svg+xml;base64,"), Not(HasSubstr("http-equiv=\"refresh\""))));
}

TEST_F(Watch, TellsOfARunThatHasEnded) {
  ASSERT_EQ(burnish("run scene.yaml -o out --quiet").code, 0);
  const Outcome ended = burnish("watch out --json --on-frame 'touch called'");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(fs::exists(dir / "called")) << "these frames are not new";
  Json::Value state;
  std::istringstream(ended.out) >> state;
  EXPECT_EQ(state["step"], 100);
  EXPECT_EQ(state["time"], 1.0);
  EXPECT_EQ(state["end_time"], 1.0);
  EXPECT_EQ(state["frames"], 5);
  EXPECT_EQ(state["completed"], true);
  expectRefusal(burnish("watch out --y disc.fyy"), "watch", "disc.fyy");
}

TEST_F(Watch, NoticesARunThatStoppedAndOneThatIsGone) {
  ASSERT_EQ(burnish("run scene.yaml -o out --quiet").code, 0);
  RunAccount account = readSummary(dir / "out");
  account.completed = false;
  account.stoppedBecause = "the step became too small";
  writeSummary(dir / "out", account);
  const Outcome stopped = burnish("watch out --page page.html");
  EXPECT_EQ(stopped.code, 3);
  EXPECT_THAT(stopped.err, HasSubstr("did not reach its end: the step became too small"));
  EXPECT_THAT(readText(dir / "page.html"), HasSubstr("The run stopped: the step became too small."));

  removeSummary(dir / "out");
  const Outcome gone = burnish("watch out --patience 0.5 --page page.html");
  EXPECT_EQ(gone.code, 2);
  EXPECT_THAT(gone.err, HasSubstr("the run is not at work any more"));
  EXPECT_THAT(readText(dir / "page.html"), HasSubstr("http-equiv=\"refresh\" content=\"2\""));
}

TEST_F(Watch, ACommandThatFailsIsToldAndTheWatchGoesOn) {
  const Outcome watched = line(
      "(sleep 1; burnish run scene.yaml -o out --quiet) & burnish watch out --wait --on-frame false; code=$?; wait; exit $code");
  EXPECT_EQ(watched.code, 4);
  EXPECT_THAT(watched.err, HasSubstr("the command failed for frame 4 at t = 1\n"));
}

TEST_F(Watch, ATerminalShowsOneStateOverTheOther) {
  ASSERT_EQ(burnish("run scene.yaml -o out --quiet").code, 0);
  const Outcome shown = line("LC_ALL=C script -qec \"'" BURNISH_COMMAND "' watch out\" /dev/null");
  EXPECT_EQ(shown.code, 0);
  EXPECT_THAT(shown.out, AllOf(HasSubstr("disc.fy"), HasSubstr("####  0\r\n")));
}

TEST(TextChart, RisesWithItsValues) {
  const TextChart ramp{.x = {0, 1}, .y = {0, 15}, .columns = 16, .rows = 2};
  EXPECT_THAT(chartLines(ramp), ElementsAre("        ▁▂▃▄▅▆▇█  15", "▁▂▃▄▅▆▇█████████  0"));
  TextChart half = ramp;
  half.end = 2.0;  // a run that has come half the way
  EXPECT_THAT(chartLines(half).back(), AllOf(HasSubstr("▁▃▅▇████"), EndsWith("          0")));
  TextChart letters = ramp;
  letters.blocks = false;
  EXPECT_THAT(chartLines(letters), ElementsAre("           #####  15", "################  0"));
  EXPECT_THAT(chartLines({.x = {0}, .y = {1}}), testing::IsEmpty());
  EXPECT_THAT(chartLines({.x = {0, 1}, .y = {1, 1}, .columns = 3, .rows = 1}), ElementsAre("▁▁▁  1  1"));
}

}  // namespace
}  // namespace burnish
