#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/recorder.h"
#include "engine/analysis/run.h"
#include "engine/core/state_archive.h"
#include "engine/core/team.h"
#include "engine/results/run_files.h"
#include "engine/solver/stepping.h"

namespace burnish::inline analysis {

/// What a run writes and shows under way: its result set, the rows of its history and how its steps converge.
/// Of several ranks the first one does so, and the others wait for it.
class RunOutput {
 public:
  /// model: in which the run begins. columns: of the history. resumes: goes on with what a stopped run left
  /// in the directory, else deletes it. countsLinear: the linear solver is one whose iterations are counted.
  /// Observer and team must outlive the object.
  RunOutput(const std::filesystem::path& directory, ModelRecord model,
            const std::vector<std::string>& columns, bool resumes, bool countsLinear, RunObserver& observer,
            const Team& team);

  const ModelRecord& model() const { return model_; }

  /// The state from which a resumed run goes on; none for a new one.
  std::optional<SavedState> restart() const;

  /// Shows the frames that a resumed run has written before it was stopped.
  void showAgain();

  /// Appends the current state to the history. Throws `RunError` if a value of it is not finite.
  template <int Dim>
  void appendRow(const Recorder<Dim>& recorder, int step, int iterations);
  bool hasRowAt(double time) const { return lastRowTime_ == time; }

  /// Appends the residuals of a step; number: from t = 0 on.
  void appendConvergence(int number, const StepReport& step);

  /// The next frame is this one, which is not written yet. Throws `RunError` if the first rank's has a value
  /// that is not finite.
  void accept(const FrameRecord& frame);
  bool hasFrameAt(double time) const { return lastFrameTime_ == time; }

  /// Writes and shows the frame that was accepted, with the state from which a stopped run goes on behind it.
  /// steps: taken so far.
  void append(const FrameRecord& frame, int steps, SavedState state);

  /// The last frame of a run that cannot go on; resumed, it tries again from the state that was kept last.
  void appendLast(const FrameRecord& frame);

  /// Keeps a state between frames from which a stopped run goes on.
  void keep(int steps, SavedState state);

  /// Writes the summary: the run has ended.
  void finish(const RunAccount& summary);

  void archive(StateArchive& archive);

 private:
  std::filesystem::path directory_;
  ModelRecord model_;
  const Team& team_;
  std::optional<RunFiles> files_;  ///< of the first rank
  bool countsLinear_;
  RunObserver& observer_;
  double lastFrameTime_ = -std::numeric_limits<double>::infinity();
  double lastRowTime_ = -std::numeric_limits<double>::infinity();
};

}  // namespace burnish::inline analysis
