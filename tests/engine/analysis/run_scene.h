#pragma once
#include <unistd.h>

#include <filesystem>
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

}  // namespace burnish::test
