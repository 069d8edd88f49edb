#pragma once
#include "engine/analysis/recorder.h"
#include "engine/core/state_archive.h"
#include "engine/results/run_account.h"

namespace burnish {

/// What a run hands back: its account, and what its results hold beside it.
struct RunSummary : RunAccount {
  bool halted = false;  ///< because the caller wanted it; can be resumed, and has no summary.yaml
  int frames = 0;
  StateQuantities end;  ///< the last state

  /// What is counted and timed from step to step.
  void archive(StateArchive& archive);
};

}  // namespace burnish
