#pragma once
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "postproc/probe/depth_numbers.h"
#include "postproc/study/run_data.h"
#include "postproc/study/study.h"

namespace burnish {

/// What became of a measure. A value with a note is no like for like with others: its run stopped early.
struct Measured {
  std::optional<double> value;
  std::string note;  ///< why there is no value, or what is to be known of it; mostly empty

  /// The value if it can be compared with others.
  std::optional<double> comparable() const { return note.empty() ? value : std::nullopt; }
};

/// A history reduced to a number. stoppedAt: last time of a run that did not come to its end. All throw
/// `Error` for expressions that are none and columns that do not exist.
Measured reduceHistory(const HistoryTable& history, const HistoryMeasure& measure,
                       std::optional<double> stoppedAt);

/// How far a history is from another one.
Measured compareHistories(const HistoryTable& history, std::optional<double> stoppedAt,
                          const HistoryTable& other, std::optional<double> otherStoppedAt,
                          const DifferenceMeasure& measure);

/// A field along a line of a frame, reduced. Throws `Error` for three dimensions and fields that do not
/// exist.
double reduceLine(const ModelRecord& model, const FrameRecord& frame, const LineMeasure& measure);

/// Median over the steps of `convergence.csv`.
Measured convergenceOverSteps(const HistoryTable& convergence);

/// Depth profiles of a study's runs that have been looked at, each of which has many numbers.
class SeenProfiles {
 public:
  /// Those of a frame of a run, computed where they are not known yet.
  const DepthNumbers& of(const RunData& run, const ResultReader& result, const FrameRecord& frame,
                         const ProbeSpec& place);

 private:
  struct Profile {
    std::string run;
    double time;
    ProbeSpec place;
    DepthNumbers numbers;
  };
  std::deque<Profile> profiles_;
};

/// A measure of a run of a study. No value if the run has no results. seen: of the same study.
Measured evaluateMeasure(const Study& study, const StudyRun& run, const MeasureSpec& measure,
                         const std::filesystem::path& studyDirectory, SeenProfiles& seen);

/// The same of a measure that is looked at alone.
inline Measured evaluateMeasure(const Study& study, const StudyRun& run, const MeasureSpec& measure,
                                const std::filesystem::path& studyDirectory) {
  SeenProfiles seen;
  return evaluateMeasure(study, run, measure, studyDirectory, seen);
}

/// A measure of a statement. No value where the results have no such thing, either, which is added to the faults, each once: study,
/// measure, statement and what is wrong.
Measured measuredOrFault(const Study& study, const StatementSpec& statement, const StudyRun& run,
                         const MeasureSpec& measure, const std::filesystem::path& studyDirectory,
                         SeenProfiles& seen, std::vector<std::string>& faults);

/// The run of a name. Throws `Error` with the nearest name.
const StudyRun& runNamed(const Study& study, const std::string& name);

}  // namespace burnish
