#pragma once
#include <vector>

#include "engine/analysis/recorder.h"
#include "engine/core/state_archive.h"
#include "engine/results/run_account.h"

namespace burnish::inline analysis {

/// What one of several ranks has of a run.
struct RankWork {
  int spans = 0;           ///< that it assembles, also those that others assemble, too
  double entries = 0.0;    ///< of K
  double bytesSent = 0.0;  ///< to other ranks, since the run began or was resumed
};

/// What a run hands back: its account, and what its results hold beside it.
struct RunSummary : RunAccount {
  bool halted = false;  ///< because the caller wanted it; can be resumed, and has no summary.yaml
  int frames = 0;
  StateQuantities end;          ///< the last state
  int spans = 0;                ///< of all bodies
  std::vector<RankWork> ranks;  ///< empty for one

  /// What is counted and timed from step to step.
  void archive(StateArchive& archive);
};

}  // namespace burnish::inline analysis
