#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "postproc/draw/contour/picture_options.h"

/// A study as a value: which scenes are run with which settings, and what is drawn and said about them.
///
/// A *pattern* names runs; `*` stands for any part of a name. Texts in braces are replaced by parameters of
/// the run at hand: "{degree}" by the value, "{basis.label}" by its label.
namespace burnish {

/// A quantity that is varied: one run for every combination of the values of all parameters.
struct ParameterSpec {
  std::string name;
  std::vector<std::string> values;
  std::vector<std::string> labels;  ///< shown instead of the values; as many, or none
};

struct RunsSpec {
  std::string name;                  ///< "plastic-{basis}-{degree}"
  std::string scene;                 ///< file, relative to the study file
  std::vector<ParameterSpec> vary;   ///< none: one run
  std::vector<std::string> set;      ///< overrides "path=value", in braces as above
  std::optional<std::string> label;  ///< of legends and tables; the name when left out
};

/// Which parameter chooses the colour, the dashes and the marker of a run's curve.
struct CurveLooks {
  std::optional<std::string> color, dash, marker;
};

/// Curves y(x), one for each run, from the histories. Expressions are formulas in the columns.
struct HistoryChartSpec {
  std::vector<std::string> runs;  ///< patterns
  std::string x = "time", y;
  std::string where = "1";  ///< rows in which this is not zero are shown
  std::string xTitle, yTitle;
  CurveLooks looks;
  std::optional<std::string> reference;  ///< PNG (shown beside) or CSV (x and y columns, drawn as points)
};

enum class SurfaceQuantity { Pressure, Gap };

/// A contact quantity over the current x position along the contact face, one picture for each time.
struct SurfaceChartSpec {
  std::vector<std::string> runs;
  std::vector<double> times;
  std::vector<std::string> timeLabels;  ///< as many as times, or none
  SurfaceQuantity quantity = SurfaceQuantity::Pressure;
  std::optional<std::array<double, 2>> window;  ///< of x; around the contact when left out
  CurveLooks looks;
};

enum class Reduction { First, Last, Max, Min, Mean, At, Oscillation };

/// A number from the history: y(x) restricted to a range of x and reduced. `oscillation`: standard deviation
/// about the least-squares quartic in x; `at`: linear interpolation.
struct HistoryMeasure {
  std::string x = "time", y;
  std::string where = "1";
  std::optional<std::array<double, 2>> range;
  Reduction reduce = Reduction::Last;
  std::optional<double> at;
};

/// A number of `summary.yaml`, such as iterations, cut_backs, seconds.
struct SummaryMeasure {
  std::string entry;
};

enum class LineReduction { Variation, Max, Min };

/// A projected field along a line of constant second parameter of the first patch, on which it is sampled at
/// 11 points per knot span. Variation: the sum of |differences|.
struct LineMeasure {
  std::string field;
  double time = 0.0;
  double height = 0.5;  ///< second parameter as a part of its range, 0 to 1
  LineReduction reduce = LineReduction::Variation;
};

/// How far y(x) is from that of another run, at the x that both have: the largest |difference| as a part of
/// the other run's largest |y|; with `tolerance`, the first x at which the difference exceeds this part.
struct DifferenceMeasure {
  std::string other;  ///< name of a run, in braces as above
  std::string x = "time", y;
  std::string where = "1";
  std::optional<std::array<double, 2>> range;
  std::optional<double> tolerance;
};

/// Median over all steps of the order log(r_k+1/r_k) / log(r_k/r_k-1) that the last residuals above rounding
/// show, from `convergence.csv`.
struct ConvergenceMeasure {};

struct MeasureSpec {
  std::string name;   ///< for claims
  std::string title;  ///< column of the table
  std::variant<HistoryMeasure, SummaryMeasure, LineMeasure, DifferenceMeasure, ConvergenceMeasure> what;
};

/// Error of a measure against the number of basis functions, log-log, a curve per combination of the other
/// parameters, with the observed order. The exact value is extrapolated from the finest three meshes (median
/// over the curves).
struct RefinementChartSpec {
  std::vector<std::string> runs;
  std::string refine;  ///< parameter that is the mesh
  MeasureSpec measure;
  std::string yTitle;
  CurveLooks looks;
};

enum class SheetScale { Panel, Row, Sheet };

/// Contour pictures in a grid: a row for each time, a column for each run.
struct ContourSheetSpec {
  std::vector<std::string> runs;
  std::vector<double> times;
  std::vector<std::string> timeLabels;  ///< "{time}" in the captions; as many as times, or none
  SheetScale scale = SheetScale::Panel;
  std::string panelCaption = "{letter}) {label}, {time}";
  PanelOptions panel = picturesOfSize<PanelOptions>({960, 480});
};

/// Geometry and boundary conditions of a run.
struct SetupSpec {
  std::string run;
};

/// Pictures of other figures in one.
struct CompositeSpec {
  std::vector<std::string> figures;
  std::vector<std::string> captions;  ///< as many as figures, or none
  int columns = 2;
};

/// Every frame of each run as a picture, and as a video if ffmpeg is there.
struct AnimationSpec {
  std::vector<std::string> runs;
  PictureOptions picture = picturesOfSize({960, 480});
  double framesPerSecond = 5.0;
};

struct FigureSpec {
  std::string name;     ///< of the file, and for --only
  std::string caption;  ///< in the document
  std::variant<HistoryChartSpec, SurfaceChartSpec, RefinementChartSpec, ContourSheetSpec, SetupSpec,
               CompositeSpec, AnimationSpec>
      what;
};

/// What the values of some runs should be like: growing in the order of the runs; all within a part of the
/// largest magnitude, or not; all in a range.
enum class Expectation { Increasing, Equal, Different, Between };

struct ClaimSpec {
  std::string text;
  std::string measure;              ///< name
  std::vector<ParameterSpec> vary;  ///< one claim for each combination
  std::vector<std::string> runs;    ///< names, in braces as above
  Expectation expect = Expectation::Increasing;
  std::optional<double> within;                ///< for `Equal` and `Different`
  std::optional<std::array<double, 2>> range;  ///< for `Between`
};

/// A section of the document: text, a table with a row for each run and a column for each measure, and what
/// became of the claims.
struct StatementSpec {
  std::string name;
  std::string title, text;
  std::vector<std::string> runs;  ///< patterns; none: no table
  std::vector<MeasureSpec> measures;
  std::vector<ClaimSpec> claims;
  std::vector<std::string> figures;  ///< names; shown below the table
};

struct StudySpec {
  std::string title, text;
  std::vector<RunsSpec> runs;
  std::vector<FigureSpec> figures;
  std::vector<StatementSpec> statements;
};

/// One run of a study with all braces replaced.
struct StudyRun {
  std::string name, label;
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::map<std::string, std::string> parameters;  ///< values and, as "basis.label", labels
};

struct Study {
  StudySpec spec;
  std::filesystem::path file;
  std::vector<StudyRun> runs;  ///< in the order of the file

  /// Runs that the patterns name, each once: those of the first pattern in the order of the study, those of
  /// the next, … Throws `Error` for a pattern that names none.
  std::vector<const StudyRun*> matching(const std::vector<std::string>& patterns) const;
};

/// The text with "{name}" replaced; braces around anything but a name stay, so that overrides may hold YAML.
/// Throws `Error` that names the text for an unknown name or an unclosed brace.
std::string fillIn(const std::string& text, const std::map<std::string, std::string>& parameters);

/// Where a run of a study keeps its results.
inline std::filesystem::path runDirectory(const std::filesystem::path& studyDirectory, const StudyRun& run) {
  return studyDirectory / "runs" / run.name;
}

}  // namespace burnish
