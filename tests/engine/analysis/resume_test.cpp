#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "engine/core/error.h"
#include "engine/results/model_io.h"
#include "engine/results/restart.h"
#include "engine/results/result_files.h"
#include "engine/results/summary_file.h"
#include "tests/engine/analysis/run_scene.h"
#include "tests/engine/scene/scene_samples.h"
#include "tests/engine/scene/two_bodies_sample.h"

/// Runs that are halted and resumed against runs that are not.
namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::haltAfter;
using test::runTo;
using test::ScratchDirectory;
using testing::HasSubstr;

/// An elastic block with F-bar under a disc that carries a force, in penalty contact.
const std::string kCarried = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
formulation: fbar
material: {law: neo-hookean, E: 1.0, nu: 0.3}
supports: [{face: bottom, fix: [x, y]}]
loads: [{face: left, traction: [0.01, 0], schedule: {times: [0, 2], values: [0, 1]}}]
tools:
  - {name: disc, shape: cylinder, center: [1.0, 1.6], radius: 0.5,
     prescribe: {x: 0.1 * t}, carry: {y: -0.02 * (1 + t)}}
contact: [{tool: disc, face: top, method: penalty, parameter: 20}]
steps: [{until: 2, count: 8}]
output: {every: 0.7}
)";

/// A block that slides over the ends of another one's spans, with friction; the method follows.
const std::string kSlide = R"(
degree: 1
bodies:
  - {name: slab, geometry: {shape: rectangle, size: [3, 0.5], spans: [15, 2]},
     material: {law: neo-hookean, E: 10, nu: 0.3}}
  - {name: block, geometry: {shape: rectangle, origin: [0.4, 0.5], size: [1, 0.5], spans: [7, 3]},
     material: {law: neo-hookean, E: 10, nu: 0.3}}
supports:
  - {body: slab, face: bottom, fix: [x, y]}
  - {body: block, face: top, move: {times: [0, 1, 2], x: [0, 0, 1], y: [0, -0.02, -0.02]}}
steps: [{until: 1, count: 2}, {until: 2, count: 8}]
output: {every: 0.7}
contact:
  - {body: block, face: bottom, against: {body: slab, face: top}, friction: 0.2, segments: true, method: )";

/// All files of a result, as they are on the disk; those whose bytes a resumed run must repeat.
std::map<std::string, std::string> filesOf(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file() || entry.path().filename() == "summary.yaml") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[entry.path().lexically_relative(directory).string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

/// Names of the files that differ, and of those that one side lacks.
std::string differences(const std::map<std::string, std::string>& a,
                        const std::map<std::string, std::string>& b) {
  std::string names;
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) names += name + " ";
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names += name + " ";
  return names;
}

RunSummary resume(const fs::path& directory, const RunOptions& options = {}) {
  RunObserver silent;
  return resumeRun(readResultScene(directory), directory, options, silent);
}

class Resume : public testing::Test {
 protected:
  void SetUp() override { runTo(whole.path(), samples::ironing, {}); }

  /// The ironing halted in mid-slide, on one thread.
  void halt() {
    const RunSummary summary = runTo(part.path(), samples::ironing, haltAfter(11, 1));
    ASSERT_TRUE(summary.halted);
    ASSERT_FALSE(summary.completed);
    ASSERT_FALSE(fs::exists(part.path() / "summary.yaml"));
  }

  std::string resumedDifferences() const { return differences(filesOf(whole.path()), filesOf(part.path())); }

  const ScratchDirectory whole{"resume_whole"}, part{"resume_part"};
};

TEST_F(Resume, TheHistoryOfTheHaltedRunIsNotTrivial) {
  halt();
  const HistoryTable history = readHistory(part.path() / "history.csv");
  EXPECT_GT(history.column("plastic_work").back(), 0.0);
  EXPECT_GE(history.column("active_control_points").back(), 1.0);
  EXPECT_GT(history.column("disc.ux").back(), 0.05);
  EXPECT_LT(history.column("time").back(), 1.95);
  EXPECT_NE(resumedDifferences(), "");
}

TEST_F(Resume, GivesTheBitsOfARunThatWasNotHalted) {
  halt();
  const RunSummary summary = resume(part.path(), {.threads = 2});
  EXPECT_TRUE(summary.completed);
  EXPECT_EQ(resumedDifferences(), "");
}

TEST_F(Resume, GivesTheSameBitsWhenHaltedAfterEveryStep) {
  RunSummary summary = runTo(part.path(), samples::ironing, haltAfter(1));
  int halts = 0;
  for (; summary.halted; ++halts) summary = resume(part.path(), haltAfter(1));
  EXPECT_TRUE(summary.completed) << summary.stoppedBecause;
  EXPECT_GE(halts, 15);
  EXPECT_EQ(resumedDifferences(), "");
}

struct Killed {};

/// Keeps the state whenever it can, and is killed after so many steps from the start or from where the run is resumed.
RunOptions killedAfter(int steps) {
  return {.threads = 1,
          .halt = [steps, taken = 0]() mutable -> bool {
            if (++taken >= steps) throw Killed();
            return false;
          },
          .keepEvery = 0.0};
}

TEST_F(Resume, GoesOnFromTheStateThatWasKeptLastWhenTheRunIsKilled) {
  EXPECT_THROW(runTo(part.path(), samples::ironing, killedAfter(11)), Killed);
  const RestartRecord last = readNewestRestart(modelFile(part.path()), readModel(modelFile(part.path())));
  const std::vector<double> times = readHistory(part.path() / "history.csv").column("time");
  const ResultReader reader(part.path());
  EXPECT_DOUBLE_EQ(last.state.at("stepping.time")(0),
                   times[times.size() - 2]);  // before the step that was the last
  EXPECT_GT(last.state.at("stepping.time")(0), reader.times().back());
  EXPECT_TRUE(resume(part.path()).completed);
  EXPECT_EQ(resumedDifferences(), "");
}

/// A block that is pressed and let go of by a support on its way, with a state that is kept after every step.
const std::string kLetGo = R"(
geometry: {shape: rectangle, size: [2.0, 1.0], functions: [8, 5]}
material: {law: j2, E: 100, nu: 0.3, hardening: {law: linear, sigma0: 1, modulus: 5}}
supports:
  - {face: bottom, fix: [x, y]}
  - {face: left, fix: [x], until: 1}
tools: [{name: disc, shape: cylinder, center: [1.0, 1.5], radius: 0.5, motion: {times: [0, 1, 2], y: [0, -0.05, 0.02]}}]
contact: [{tool: disc, face: top}]
steps: [{until: 1, count: 4}, {until: 2, count: 4}]
output: {every: 2}
)";

TEST(KeptStates, AreThoseOfTheWholeRunHoweverOftenItIsKilled) {
  for (const std::string& scene : {std::string(samples::ironing), kCarried, kLetGo}) {
    const ScratchDirectory whole("kept_whole"), part("kept_part");
    ASSERT_TRUE(runTo(whole.path(), scene, {}).completed);
    bool completed = false;
    int kills = 0;
    const auto attempt = [&](const auto& go) {
      try {
        completed = go().completed;
      } catch (const Killed&) {
        ++kills;
      }
    };
    attempt([&] { return runTo(part.path(), scene, killedAfter(2)); });
    while (!completed && kills < 100) attempt([&] { return resume(part.path(), killedAfter(2)); });
    EXPECT_TRUE(completed);
    EXPECT_GE(kills, 6);
    EXPECT_EQ(differences(filesOf(whole.path()), filesOf(part.path())), "");
  }
}

TEST_F(Resume, CountsWhatTheWholeRunCounts) {
  const RunSummary all = runTo(whole.path(), samples::ironing, {});
  halt();
  const RunSummary resumed = resume(part.path());
  const auto counted = [](const RunSummary& s) {
    auto numbers = numbersOf(s);
    std::erase_if(numbers, [](const auto& number) { return number.first.ends_with("seconds"); });
    return numbers;
  };
  EXPECT_EQ(counted(resumed), counted(all));
  EXPECT_EQ(resumed.doubts.size(), all.doubts.size());
}

/// Every part of the saved state matters: a run that lost it goes elsewhere.
class LostState : public Resume, public testing::WithParamInterface<const char*> {};

TEST_P(LostState, ChangesTheResult) {
  halt();
  const fs::path model = modelFile(part.path());
  const StoredModel stored = readModel(model);
  RestartRecord record = readNewestRestart(model, stored);
  Eigen::VectorXd& values = record.state.at(GetParam());
  if (std::string(GetParam()) == "term0.history") {
    for (Eigen::Index point = 0; point < values.size(); point += 19) {
      values.segment(point, 18) << Eigen::Matrix3d::Identity().reshaped(),
          Eigen::Matrix3d::Identity().reshaped();
      values(point + 18) = 0.0;
    }
  } else {
    values.setZero(std::string(GetParam()).ends_with("increment") ? 0 : values.size());
  }
  writeRestart(model, record, stored.id);
  resume(part.path());
  EXPECT_NE(resumedDifferences(), "") << GetParam();
}

INSTANTIATE_TEST_SUITE_P(All, LostState,
                         testing::Values("term0.history", "term0.plastic_work", "stepping.last_increment",
                                         "stepping.last_size", "recorder.history.current.tool0_force"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(ResumeOfOtherRuns, ToolsWithFreeWaysLoadsAndProjectedDilatation) {
  const ScratchDirectory whole("resume_carried_whole"), part("resume_carried_part");
  runTo(whole.path(), kCarried, {});
  for (const int steps : {1, 3, 6}) {
    ASSERT_TRUE(runTo(part.path(), kCarried, haltAfter(steps)).halted);
    ASSERT_TRUE(resume(part.path()).completed);
    EXPECT_EQ(differences(filesOf(whole.path()), filesOf(part.path())), "") << steps;
  }
}

TEST(ResumeOfOtherRuns, SeveralBodies) {
  const ScratchDirectory whole("resume_bodies_whole"), part("resume_bodies_part");
  runTo(whole.path(), samples::twoBodies, {});
  for (const int steps : {1, 3}) {
    ASSERT_TRUE(runTo(part.path(), samples::twoBodies, haltAfter(steps)).halted);
    ASSERT_TRUE(resume(part.path()).completed);
    EXPECT_EQ(differences(filesOf(whole.path()), filesOf(part.path())), "") << steps;
  }
}

/// What penalties remember of friction, where a part sticks and a part slips: of two bodies, and in space.
TEST(ResumeOfOtherRuns, PenaltiesThatRub) {
  const std::string bodies = R"(
bodies:
  - {name: slab, geometry: {shape: rectangle, origin: [-1, -1], size: [3, 1], spans: [9, 2]}, material: {law: neo-hookean, E: 30, nu: 0.3}}
  - {name: block, geometry: {shape: rectangle, size: [1, 1], spans: [4, 3]}, material: {law: neo-hookean, E: 10, nu: 0.3}}
supports:
  - {body: slab, face: bottom, fix: [x, y]}
  - {body: block, face: top, move: {times: [0, 1, 2], x: [0, 0, 0.06], y: [0, -0.05, -0.05]}}
contact: [{body: block, face: bottom, against: {body: slab, face: top}, friction: 0.3, method: METHOD}]
steps: [{until: 1, count: 2}, {until: 2, count: 5}]
output: {every: 0.4}
)",
                    space = R"(
geometry: {shape: box, size: [1, 1, 1], spans: [2, 2, 2]}
material: {law: neo-hookean, E: 10, nu: 0.3}
supports: [{face: front, move: {times: [0, 1, 2], x: [0, 0, 0.1], y: [0, 0, 0.02], z: [0, -0.05, -0.05]}}]
tools: [{name: ball, shape: sphere, center: [0.5, 0.4, -5], radius: 5}]
contact: [{tool: ball, face: back, friction: 0.3, method: METHOD}]
steps: [{until: 1, count: 2}, {until: 2, count: 5}]
output: {every: 0.4}
)";
  for (const auto& [scene, name] : {std::pair{&bodies, "block-slab"}, {&space, "ball"}})
    for (const char* method : {"penalty", "pointwise-penalty"}) {
      std::string text = *scene;
      text.replace(text.find("METHOD"), 6, method);
      const ScratchDirectory whole("resume_rubbing_whole"), part("resume_rubbing_part");
      ASSERT_TRUE(runTo(whole.path(), text, {}).completed);
      const HistoryTable history = readHistory(whole.path() / "history.csv");
      ASSERT_TRUE(runTo(part.path(), text, haltAfter(6)).halted);
      EXPECT_GT(history.column(std::string(name) + ".sticking")[6], 0.0) << method;
      EXPECT_GT(history.column(std::string(name) + ".slipping")[6], 0.0) << method;
      ASSERT_TRUE(resume(part.path()).completed);
      EXPECT_EQ(differences(filesOf(whole.path()), filesOf(part.path())), "") << name << method;
    }
}

TEST(ResumeOfOtherRuns, ASlideOfABodyOverAnotherWithSegments) {
  for (const char* method : {"augmented-lagrangian", "integral-augmented-lagrangian", "penalty"}) {
    const std::string scene = kSlide + method + "}\n";
    const ScratchDirectory whole("resume_slide_whole"), part("resume_slide_part");
    runTo(whole.path(), scene, {});
    for (const int steps : {1, 4, 7}) {
      ASSERT_TRUE(runTo(part.path(), scene, haltAfter(steps)).halted);
      ASSERT_TRUE(resume(part.path()).completed);
      EXPECT_EQ(differences(filesOf(whole.path()), filesOf(part.path())), "") << method << steps;
    }
  }
}

TEST(RunsThatCannotGoOn, SayWhereAndWhatHelpsAndKeepTheirFrames) {
  const ScratchDirectory directory("resume_failed");
  RunObserver silent;
  const Scene scene = parseScene(samples::ironing, "test.yaml",
                                 {"solver.max_cuts=0", "steps=[{until: 1, count: 1}, {until: 2, count: 3}]"});
  const RunSummary summary = runScene(scene, directory.path(), {}, silent);
  ASSERT_FALSE(summary.completed);
  ASSERT_FALSE(summary.halted);
  EXPECT_THAT(summary.stoppedBecause, HasSubstr("the residual is largest at the control point at X = ("));
  EXPECT_THAT(summary.stoppedBecause, HasSubstr("control points of face 'top' touch tool 'disc', "));
  EXPECT_THAT(summary.stoppedBecause, HasSubstr("the smallest J is 0.9"));
  EXPECT_THAT(summary.advice, HasSubstr("solver.max_cuts"));
  EXPECT_EQ(readSummary(directory.path()).advice, summary.advice);
  EXPECT_EQ(ResultReader(directory.path()).numFrames(), summary.frames);
  EXPECT_GE(summary.frames, 1);
}

std::string refusal(const fs::path& directory) {
  try {
    resume(directory);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Resume, ACompletedRunHasNothingToResume) {
  EXPECT_THAT(refusal(whole.path()), HasSubstr("there is no restart record"));
}

TEST_F(Resume, TablesThatWereShortenedAreRefused) {
  halt();
  fs::resize_file(part.path() / "history.csv", 100);
  EXPECT_THAT(refusal(part.path()), HasSubstr("history.csv is shorter than the"));
  fs::remove(part.path() / "history.csv");
  EXPECT_THAT(refusal(part.path()), HasSubstr("history.csv: No such file"));
}

TEST_F(Resume, TablesWhoseRowsWereChangedAreRefused) {
  for (const char* table : {"history.csv", "convergence.csv"}) {
    halt();
    const fs::path file = part.path() / table;
    std::string text = filesOf(part.path()).at(table);
    const std::size_t digit = text.find_first_of("123456789", text.find('\n', text.find('\n') + 1));
    text[digit] = text[digit] == '1' ? '2' : '1';
    std::ofstream(file) << text;
    EXPECT_THAT(refusal(part.path()), HasSubstr(std::string(table) + " is not as the run wrote it"));
    EXPECT_EQ(filesOf(part.path()).at(table), text) << "was cut";
  }
}

TEST_F(Resume, ADamagedRecordIsRefused) {
  halt();
  const fs::path record = restartFiles(modelFile(part.path())).front();
  std::fstream file(record, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(fs::file_size(record) / 2));
  file.write("damage", 6);
  file.close();
  EXPECT_THAT(refusal(part.path()), HasSubstr("the run cannot be resumed: " + record.string()));
}

TEST_F(Resume, GoesOnFromTheFrameBeforeIfARecordWaitsForItsFrame) {
  halt();
  const fs::path model = modelFile(part.path());
  const StoredModel stored = readModel(model);
  // As if the run had been killed between writing the record of the next frame and the frame.
  RestartRecord next = readNewestRestart(model, stored);
  ++next.frames;
  next.step += 1;
  next.state["stepping.time"].setConstant(99.0);
  writeRestart(model, next, stored.id);
  EXPECT_TRUE(resume(part.path()).completed);
  EXPECT_EQ(resumedDifferences(), "");
}

}  // namespace
}  // namespace burnish
