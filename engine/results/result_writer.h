#pragma once
#include <filesystem>

#include "engine/core/directory_lock.h"
#include "engine/results/model_io.h"
#include "engine/results/restart.h"
#include "engine/results/result.h"

namespace burnish::inline results {

/// Writes a result, one file per frame, each under its final name only when it is complete and on the disk:
/// at every moment, and after the process was killed at any moment, `ResultReader` finds all frames appended
/// so far.
class ResultWriter {
 public:
  /// Creates the directory if needed, deletes an earlier result in it with its summary (and nothing
  /// else) and writes the model. Throws `Error` if that is impossible, if the directory holds a foreign file
  /// in the place of a result, if another process is writing a result there, or if the model contradicts
  /// itself.
  ResultWriter(const std::filesystem::path& directory, ModelRecord model);

  /// Goes on with the result of a run that was stopped, from its newest restart record, which it hands over.
  /// Frames after that are deleted. Throws `Error` if the directory holds no such result, if its model is not
  /// this one, or if another process is writing a result there.
  ResultWriter(const std::filesystem::path& directory, ModelRecord model, RestartRecord& restart);

  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// The frame's index must be the number of frames appended before. Throws `Error` if it is not, if the
  /// frame does not fit the model, or if the disk refuses; the frames before stay readable.
  void append(const FrameRecord& frame);

  /// As before, and from now on a stopped run goes on from `restart`, of the same state. Killed at any
  /// moment, it goes on from the newest frame that is complete, or from the state that was kept since.
  void append(const FrameRecord& frame, const RestartRecord& restart);

  /// A stopped run goes on from here; no frame belongs to this state.
  void keep(const RestartRecord& restart);

  /// The run has come to its end.
  void removeRestarts();

  int numFrames() const { return numFrames_; }

 private:
  void check(const FrameRecord& frame) const;
  void write(const FrameRecord& frame);

  DirectoryLock lock_;
  std::filesystem::path modelFile_;
  StoredModel model_;
  int numFrames_ = 0;
};

}  // namespace burnish::inline results
