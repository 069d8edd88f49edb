#pragma once
#include <filesystem>

#include "engine/core/state_archive.h"
#include "engine/results/history.h"
#include "engine/results/model_io.h"

namespace burnish::inline results {

/// Where a stopped run goes on.
struct RestartRecord {
  int step = 0;                    ///< number of steps taken; names the record
  int frames = 0;                  ///< frames of the result up to this state
  TableMark history, convergence;  ///< the tables up to this state
  SavedState state;
};

/// `NAME/restart_000123.h5` beside the frames. Written whole, as frames are. Throws `Error` if the disk
/// refuses.
void writeRestart(const std::filesystem::path& modelFile, const RestartRecord& record,
                  const std::string& modelId);

/// The newest record that can be read and whose frames are all there; older ones stand beside it only if the
/// run was killed while it wrote. Throws `Error` if there is none, naming what is wrong with the newest.
RestartRecord readNewestRestart(const std::filesystem::path& modelFile, const StoredModel& model);

/// Deletes the records of steps before `step`. Throws `Error` if the file system refuses.
void removeRestartsBefore(const std::filesystem::path& modelFile, int step);

}  // namespace burnish::inline results
