#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "postproc/draw/chart/chart.h"
#include "postproc/study/study.h"

/// The kinds of figures. Every function draws one into the files of its task and returns them, the picture
/// itself first. They throw `Error` as `drawFigure` does.
namespace burnish {

using Files = std::vector<std::filesystem::path>;

/// A figure that is to be drawn.
struct FigureTask {
  const Study& study;
  const FigureSpec& figure;
  const std::filesystem::path& studyDirectory;

  std::filesystem::path directory() const { return studyDirectory / "figures"; }

  /// DIR/figures/NAMEending.
  std::filesystem::path file(const std::string& ending) const { return directory() / (figure.name + ending); }
};

Files drawKind(const FigureTask& task, const HistoryChartSpec& spec);
Files drawKind(const FigureTask& task, const SurfaceChartSpec& spec);
Files drawKind(const FigureTask& task, const RefinementChartSpec& spec);
Files drawKind(const FigureTask& task, const ContourSheetSpec& spec);
Files drawKind(const FigureTask& task, const SetupSpec& spec);
Files drawKind(const FigureTask& task, const CompositeSpec& spec);
Files drawKind(const FigureTask& task, const AnimationSpec& spec);

/// The look of a run's curve: the number of the value that each chosen parameter has. Nothing without looks.
std::optional<CurveStyle> styleOf(const Study& study, const StudyRun& run, const CurveLooks& looks);

/// "t = 1.5", or the label of the time if there are labels.
std::string timeText(const std::vector<double>& times, const std::vector<std::string>& labels,
                     std::size_t number);

/// The text, and in brackets that the run stopped before what is shown.
std::string withStop(const std::string& text, double stoppedAt);

/// The figure of a name. Throws `Error` with the nearest name.
const FigureSpec& figureNamed(const Study& study, const std::string& name);

}  // namespace burnish
