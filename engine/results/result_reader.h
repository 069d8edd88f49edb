#pragma once
#include <filesystem>
#include <vector>

#include "engine/results/model_io.h"
#include "engine/results/result.h"

namespace burnish::inline results {

/// Reads a result, also while the run that makes it goes on. Everything read is checked: sizes agree, indices
/// are in range. Every member throws `Error` for files that are missing, foreign, damaged or of another
/// format.
class ResultReader {
 public:
  /// The directory of a run or the result file in it.
  explicit ResultReader(const std::filesystem::path& directoryOrFile);

  const std::filesystem::path& file() const { return modelFile_; }
  const ModelRecord& model() const { return model_.record; }

  /// Number of frames that were complete when the result was opened.
  int numFrames() const { return numFrames_; }

  /// Times of these frames.
  std::vector<double> times() const;

  /// 0 <= index < numFrames(), else `Error`.
  FrameRecord frame(int index) const;

 private:
  std::filesystem::path modelFile_;
  StoredModel model_;
  int numFrames_;
};

}  // namespace burnish::inline results
