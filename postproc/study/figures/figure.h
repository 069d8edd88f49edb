#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/schema/leaf.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/draw/page/print_file.h"

/// What the kinds of figures share. A kind is a struct of its parameters with a `describe` beside it and
///
///     static Alternative about()                     its name as a `kind` in a study, and what it shows
///     Files draw(task) const                         draws it into the files of the task and returns them, the
///                                                    picture itself first; throws `Error` as `drawFigure` does
///
/// and, where the kind has something to say, of the following
///
///     PrintPage page(task) const                     the picture for print; what has none is made of pixels alone
///     void check(path, reporter) const               reports what is wrong before the runs are known
///     void checkReferences(path, reporter) const     reports what is wrong with names of runs and the like
///     void checkOutlooks(path, reporter) const       reports what it shows of runs that their results will not have
///     shownRuns(study) const                         runs whose results it shows; of its patterns `runs` else
///     inputs(studyFile) const                        files that it shows beside
///     parts() const                                  names of other figures that it shows
///     clipOfAll() const                              percentile at which the colours of all pictures end
namespace burnish {

struct Study;
struct StudyRun;
class StudyReporter;
class RunReporter;
class OutlookReporter;

using Files = std::vector<std::filesystem::path>;

/// A figure that is to be drawn.
struct FigureTask {
  const Study& study;
  const std::string& name;
  const std::filesystem::path& studyDirectory;
  PrintOptions print{};

  std::filesystem::path directory() const { return studyDirectory / "figures"; }

  /// DIR/figures/NAMEending.
  std::filesystem::path file(const std::string& ending) const { return directory() / (name + ending); }
};

inline constexpr int kChartWidth = 1200;  ///< pixels

/// A page as wide as a panel of a sheet on paper.
PrintPage asColumn(PrintPage page);

/// A chart with the data that it shows beside it.
Files drawWithData(const Chart& chart, const std::filesystem::path& png);

/// Which parameter chooses the colour, the dashes and the marker of a run's curve.
struct CurveLooks {
  std::optional<std::string> color, dash, marker;
};

/// The look of a run's curve: the number of the value that each chosen parameter has. Nothing without looks.
std::optional<CurveStyle> styleOf(const Study& study, const StudyRun& run, const CurveLooks& looks);

/// "t = 1.5", or the label of the time if there are labels.
std::string timeText(const std::vector<double>& times, const std::vector<std::string>& labels,
                     std::size_t number);

/// The text, and in brackets that the run stopped before what is shown.
std::string withStop(const std::string& text, double stoppedAt);

template <class Visitor>
void describe(Visitor& v, CurveLooks& s) {
  v.field("color", s.color, {}, "Parameter that chooses the colour.");
  v.field("dash", s.dash, {}, "Parameter that chooses the dashes.");
  v.field("marker", s.marker, {}, "Parameter that chooses the marker.");
}

template <class Visitor>
void describeRuns(Visitor& v, std::vector<std::string>& runs) {
  v.field("runs", runs, {.required = true, .minEntries = 1}, "Names of runs, * for any part of a name.");
}

template <class Visitor>
void describeLooks(Visitor& v, CurveLooks& looks) {
  v.field("looks", looks, {}, "Which parameters tell the curves apart.");
}

template <class Visitor>
void describeTimes(Visitor& v, std::vector<double>& times, std::vector<std::string>& labels) {
  v.field("times", times,
          {.required = true, .atLeast = 0, .increasing = true, .minEntries = 1, .unit = "time"},
          "Times of frames.");
  v.field("time_labels", labels, {.longest = kLongestShownText},
          "What is written instead of t = ..., one for each time.");
}

}  // namespace burnish
