#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/summary_file.h"
#include "postproc/study/study.h"

namespace burnish {

/// What a run of a study has left in its directory.
class RunData {
 public:
  /// Throws `Error` that names the run if it has not ended.
  RunData(const StudyRun& run, const std::filesystem::path& studyDirectory);

  const StudyRun& run() const { return run_; }
  const RunAccount& summary() const { return summary_; }
  HistoryTable history() const { return readHistory(directory_ / "history.csv"); }
  HistoryTable convergence() const { return readHistory(directory_ / "convergence.csv"); }
  ResultReader result() const { return ResultReader(directory_); }

  /// The last time of a run that did not come to its end.
  std::optional<double> stoppedAt() const;

  /// A number of the summary. Throws `Error` naming those that there are.
  double number(const std::string& entry) const;

 private:
  const StudyRun& run_;
  std::filesystem::path directory_;
  RunAccount summary_;
};

/// Whether a run has ended, at its end or before.
bool hasEnded(const StudyRun& run, const std::filesystem::path& studyDirectory);

/// "stopped at t = 1.43".
std::string stoppedText(double time);

/// The time that stands for the end of a run, whatever that is.
inline constexpr double kEndOfRun = std::numeric_limits<double>::max();

/// The frame at a time, or the last one of a run that stopped before. Throws `Error` naming the times of the
/// frames if there is none.
struct FrameAt {
  FrameRecord frame;
  bool stoppedBefore = false;
};
FrameAt frameAt(const RunData& data, const ResultReader& result, double time);

}  // namespace burnish
