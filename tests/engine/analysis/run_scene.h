#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "engine/analysis/run.h"
#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/scene/reader.h"

namespace burnish::test {

/// A directory that disappears with the object.
class ScratchDirectory {
 public:
  explicit ScratchDirectory(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("burnish_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
  }
  ~ScratchDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What a finished run left behind.
struct Outcome {
  RunSummary summary;
  HistoryTable history;
  FrameRecord lastFrame;
  ModelRecord model;
};

inline Outcome run(const Scene& scene, const std::string& name, int threads = 0) {
  const ScratchDirectory directory(name);
  RunObserver silent;
  Outcome outcome;
  outcome.summary = runScene(scene, directory.path(), {.threads = threads}, silent);
  outcome.history = readHistory(directory.path() / "history.csv");
  ResultReader reader(directory.path());
  outcome.model = reader.model();
  outcome.lastFrame = reader.frame(reader.numFrames() - 1);
  return outcome;
}

/// A run that is stopped after so many steps, from the start or from where it is resumed.
inline RunOptions haltAfter(int steps, int threads = 0) {
  return {.threads = threads, .halt = [steps, taken = 0]() mutable { return ++taken >= steps; }};
}

inline RunSummary runTo(const std::filesystem::path& directory, const std::string& scene,
                        const RunOptions& options = {}) {
  RunObserver silent;
  return runScene(parseScene(scene, "test.yaml"), directory, options, silent);
}

inline std::string bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Value of a column at the end.
inline double last(const HistoryTable& history, const std::string& column) {
  return history.column(column).back();
}

/// `history.csv` of a run, and of one of the same scene that is halted after every step and resumed.
struct HaltedHistory {
  std::string whole, halted;
  int halts = 0;
};

inline HaltedHistory haltedAfterEveryStep(const Scene& scene, const std::string& name) {
  const ScratchDirectory whole(name + "_whole"), part(name + "_part");
  RunObserver silent;
  runScene(scene, whole.path(), {}, silent);
  const RunOptions halting{.halt = [] { return true; }};
  HaltedHistory found;
  for (RunSummary summary = runScene(scene, part.path(), halting, silent); summary.halted; ++found.halts)
    summary = resumeRun(readResultScene(part.path()), part.path(), halting, silent);
  found.whole = bytes(whole.path() / "history.csv");
  found.halted = bytes(part.path() / "history.csv");
  return found;
}

}  // namespace burnish::test
