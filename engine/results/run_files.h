#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/result_writer.h"
#include "engine/results/summary_file.h"

namespace burnish::inline results {

/// Everything that a run writes into its directory: the result set, `history.csv`, `convergence.csv` and
/// `summary.yaml`, so that the run can be stopped at any moment and resumed. Every member throws `Error` if
/// the disk refuses; what was written before stays readable.
class RunFiles {
 public:
  /// resumes: goes on with what a stopped run left in the directory, else deletes it. columns: of the
  /// history. countsLinear: rows of the convergence end with iterations of the linear solver.
  RunFiles(const std::filesystem::path& directory, const ModelRecord& model,
           const std::vector<std::string>& columns, bool resumes, bool countsLinear = false);

  /// Where a resumed run goes on; null for a new one.
  const RestartRecord* restart() const { return restart_ ? &*restart_ : nullptr; }

  void appendHistory(const std::vector<double>& row) { history_.append(row); }
  void appendConvergence(const std::vector<double>& row) { convergence_.append(row); }

  /// A frame, and the state from which a stopped run goes on behind it. step: number of steps taken.
  void append(const FrameRecord& frame, int step, SavedState state);

  /// The last frame of a run that cannot go on; resumed, it tries again from the frame before.
  void appendLast(const FrameRecord& frame) { writer_.append(frame); }

  /// A state between frames from which a stopped run goes on.
  void keep(int step, SavedState state);

  /// The end of the run; one that is completed cannot be resumed.
  void finish(const RunAccount& account);

 private:
  RestartRecord makeRestart(int step, int frames, SavedState state);

  std::filesystem::path directory_;
  std::optional<RestartRecord> restart_;
  ResultWriter writer_;
  HistoryWriter history_, convergence_;
};

/// Whether a run in this directory was stopped and left a state to go on from.
bool canBeResumed(const std::filesystem::path& directory);

}  // namespace burnish::inline results
