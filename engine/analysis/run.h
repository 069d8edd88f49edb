#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/analysis/run_summary.h"
#include "engine/core/team.h"
#include "engine/results/result.h"
#include "engine/scene/scene.h"
#include "engine/solver/newton.h"

namespace burnish::inline analysis {

struct RunOptions {
  /// 0: as many as the machine has, one for each of several ranks; results do not depend on it.
  int threads = 0;

  /// Asked after every step; the run halts when it says true, and can be resumed.
  std::function<bool()> halt = [] { return false; };

  /// That computes the run together; it halts when `halt` says so in any of them. Must outlive the run.
  const Team* team = &alone();

  /// Seconds after which the state of a run is kept between frames, too: one that is killed loses no more than these and
  /// the step under way.
  double keepEvery = 600.0;
};

/// Where a run stands, after every accepted step.
struct RunProgress {
  int step = 0;
  double time = 0.0;
  double endTime = 0.0;
  int iterations = 0;  ///< of this step, failed attempts included
  int totalCuts = 0;
};

/// Is told what happens during a run; of several ranks, that of the first one.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// Before anything is written, but for a resumed run: may throw `Error` to refuse the scene.
  virtual void onModel(const ModelRecord&) {}

  /// Before the run begins: what is probably not meant in the scene, with places.
  virtual void onWarnings(const std::vector<std::string>&) {}
  virtual void onStart(const ModelRecord&) {}
  virtual void onStep(const RunProgress&) {}

  /// A resumed run shows the frames that it has already, too.
  virtual void onFrame(const ModelRecord&, const FrameRecord&) {}
};

/// Computes a scene and writes its result set, `history.csv`, `convergence.csv` and, at its end,
/// `summary.yaml` into a directory. A run that cannot reach its end keeps everything computed so far and says
/// why in the summary. Throws `Error` before anything is written if the scene cannot be computed, or when the
/// directory cannot be written; a run that has written a frame before can be resumed. Of several ranks the
/// first one alone reads and writes in the directory; it can be resumed by another number of them.
RunSummary runScene(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                    RunObserver& observer);

/// The scene of the result in a directory, every default filled in, without what the document around it
/// wanted of the run. Throws `Error` if there is none.
Scene readResultScene(const std::filesystem::path& directory);

/// Goes on with the run in a directory that was halted, killed, or could not be brought to its end, from its
/// newest restart record, as `runScene` does; scene: that of the result, with the same `wanted`. Everything
/// that is written has the same bits as if the run had not been stopped. Throws `Error` if there is nothing
/// to resume or the program or a file that the scene names is not the same.
RunSummary resumeRun(const Scene& scene, const std::filesystem::path& directory, const RunOptions& options,
                     RunObserver& observer);

}  // namespace burnish::inline analysis
