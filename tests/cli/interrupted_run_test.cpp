#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/run_files.h"
#include "tests/cli/shell_test.h"
#include "tests/engine/scene/scene_samples.h"

/// The program is killed, interrupted, or has no room left: what it leaves is whole, and what is resumed
/// comes out as if nothing had happened. BURNISH_COMMAND is its path.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A coarse mesh and many small steps.
std::string scene() {
  std::string text = samples::ironing;
  for (const auto& [from, to] :
       {std::pair{"[30, 8]", "[12, 4]"}, std::pair{"count: 4}", "count: 20}"},
        std::pair{"count: 10}", "count: 150}"}, std::pair{"every: 0.4", "every: 0.4, vtu: false"}})
    text = samples::replaced(text, from, to);
  return text;
}

class InterruptedRun : public ShellTest {
 protected:
  void SetUp() override {
    ShellTest::SetUp();
    std::ofstream(dir / "scene.yaml") << scene();
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(burnish("run scene.yaml -o whole --quiet").code, 0);
    wholeSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  Outcome burnish(const std::string& arguments) const { return shell(dir, BURNISH_COMMAND " " + arguments); }

  /// Starts a run into `part` and sends it a signal after a while.
  Outcome interrupt(const std::string& arguments, const char* signal, double seconds) const {
    return shell(dir, fmt::format("{} {} & process=$!; sleep {:.3f}; kill -{} $process; wait $process",
                                  BURNISH_COMMAND, arguments, seconds, signal));
  }

  /// Starts a run into `part` and does something to it, a line of the shell, when it has written two frames.
  Outcome disturb(const std::string& arguments, const std::string& line) const {
    // Shells have what they start in the background ignore SIGINT.
    return shell(dir, fmt::format("env --default-signal=INT {} {} & process=$!; "
                                  "until [ -e part/result/frame_000001.h5 ]; do sleep 0.005; done; {}",
                                  BURNISH_COMMAND, arguments, line));
  }

  /// What `diff` says about the files of the run and those of the one that was not interrupted.
  std::string differences() const { return shell(dir, "diff -rq --exclude=summary.yaml whole part").out; }

  double wholeSeconds = 0.0;
};

TEST_F(InterruptedRun, KilledAtRandomMomentsLeavesWholeFramesAndIsResumedToTheSameBits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0.05 * wholeSeconds, 0.8 * wholeSeconds);
  constexpr int kKills = 50;
  int cutShort = 0, resumed = 0, killsSince = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    // Every third time the run is not begun anew but resumed, and killed again.
    const bool goesOn = kill % 3 == 2 && fs::exists(dir / "part/result/frame_000000.h5");
    interrupt(goesOn ? "run --resume part --quiet" : "run scene.yaml -o part --quiet", "KILL",
              moment(random));
    ++killsSince;
    if (!fs::exists(dir / "part/result.h5")) continue;  // killed before the first byte
    const ResultReader result(dir / "part");
    double last = -1.0;
    for (int k = 0; k < result.numFrames(); ++k) {
      const FrameRecord frame = result.frame(k);
      ASSERT_GT(frame.time, last) << "kill " << kill << ", frame " << k;
      last = frame.time;
    }
    if (result.numFrames() == 0) continue;
    ASSERT_GE(readHistory(dir / "part/history.csv").column("time").back(), last) << "kill " << kill;
    if (!fs::exists(dir / "part/summary.yaml")) ++cutShort;
    // Not a run that was faster than the signal, nor one that was killed while it removed the one before.
    if (killsSince < 5 || fs::exists(dir / "part/summary.yaml") || !canBeResumed(dir / "part")) continue;
    const Outcome outcome = burnish("run --resume part --quiet");
    ASSERT_EQ(outcome.code, 0) << "kill " << kill << ": " << outcome.err;
    ASSERT_EQ(differences(), "") << "kill " << kill;
    ++resumed;
    killsSince = 0;
  }
  EXPECT_GE(cutShort, kKills / 5);
  EXPECT_GE(resumed, kKills / 10);
}

TEST_F(InterruptedRun, SignalsFinishTheStepAndSayHowToGoOn) {
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 143}}) {
    const Outcome outcome =
        disturb("run scene.yaml -o part --quiet", fmt::format("kill -{} $process; wait $process", signal));
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("go on with: burnish run --resume part"));
    EXPECT_FALSE(fs::exists(dir / "part/summary.yaml"));
    EXPECT_EQ(burnish("run --resume part --quiet").code, 0);
    EXPECT_EQ(differences(), "") << signal;
    fs::remove_all(dir / "part");
  }
}

TEST_F(InterruptedRun, NoRoomLeftKeepsTheFramesAndCanBeResumed) {
  // The first frame fits, the history of the whole run does not.
  const Outcome outcome = shell(
      dir, fmt::format("bash -c 'ulimit -f 40; exec {} run scene.yaml -o part --quiet'", BURNISH_COMMAND));
  ASSERT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("File too large"));
  EXPECT_THAT(outcome.err, HasSubstr("burnish run --resume part"));
  const ResultReader result(dir / "part");
  ASSERT_GE(result.numFrames(), 1);
  for (int k = 0; k < result.numFrames(); ++k) EXPECT_NO_THROW(result.frame(k));
  EXPECT_EQ(burnish("run --resume part --quiet").code, 0);
  EXPECT_EQ(differences(), "");
}

TEST_F(InterruptedRun, FilesThatVanishUnderWayAreNoticed) {
  const Outcome outcome = disturb("run scene.yaml -o part --quiet", "rm -f part/history.csv; wait $process");
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("part/history.csv was removed while it was being written"));
}

TEST_F(InterruptedRun, ASecondRunIntoTheSameDirectoryIsRefused) {
  const Outcome outcome = disturb(
      "run scene.yaml -o part --quiet",
      fmt::format("kill -STOP $process; "
                  "{0} run scene.yaml -o part --quiet; echo second $?; {0} run --resume part; echo third $?; "
                  "kill -KILL $process; wait $process; {0} run --resume part --quiet; echo fourth $?",
                  BURNISH_COMMAND));
  EXPECT_THAT(outcome.out, HasSubstr("second 2"));
  EXPECT_THAT(outcome.out, HasSubstr("third 2"));
  EXPECT_THAT(outcome.err, HasSubstr("another run is writing its result to part"));
  // The lock of the killed run is gone with it.
  EXPECT_THAT(outcome.out, HasSubstr("fourth 0"));
  EXPECT_EQ(differences(), "");
}

TEST_F(InterruptedRun, ContinueGoesOnOrBeginsAnew) {
  const std::string command = "run --continue scene.yaml -o part --quiet";
  disturb(command, "kill -TERM $process; wait $process");
  const auto begun = fs::last_write_time(dir / "part/result.h5");
  EXPECT_EQ(burnish(command).code, 0);
  EXPECT_EQ(differences(), "");
  EXPECT_EQ(fs::last_write_time(dir / "part/result.h5"), begun);

  fs::remove_all(dir / "part");
  disturb(command, "kill -KILL $process; wait $process");
  fs::resize_file(dir / "part/history.csv", 10);
  const Outcome anew = burnish(command);
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_EQ(differences(), "");
}

TEST_F(InterruptedRun, ResumeSaysWhatItCannotDo) {
  EXPECT_EQ(burnish("run --resume whole").code, 0);
  EXPECT_THAT(burnish("run --resume whole").out, HasSubstr("nothing to resume"));
  EXPECT_THAT(burnish("run --resume nowhere").err, HasSubstr("nowhere: there is no such file or directory"));
  EXPECT_EQ(burnish("run --resume nowhere").code, 2);
  EXPECT_FALSE(fs::exists(dir / "nowhere"));
  EXPECT_EQ(burnish("run --resume whole scene.yaml").code, 2);
  EXPECT_EQ(burnish("run").code, 2);
}

}  // namespace
}  // namespace burnish
