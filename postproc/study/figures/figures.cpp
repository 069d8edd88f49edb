#include "postproc/study/figures/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/draw/setup/setup_figure.h"
#include "postproc/study/evidence/measures.h"
#include "postproc/study/figures/figure_kinds.h"
#include "postproc/study/run_data.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// Width of a column of a composite in pixels; charts have this width too, so they keep their size.
constexpr int kColumnWidth = 1200;

/// Each of the runs once, in the order of the study.
std::vector<const StudyRun*> inOrder(const Study& study, const std::vector<const StudyRun*>& wanted) {
  std::vector<const StudyRun*> runs;
  for (const StudyRun& run : study.runs)
    if (std::find(wanted.begin(), wanted.end(), &run) != wanted.end()) runs.push_back(&run);
  return runs;
}

void append(std::vector<const StudyRun*>& runs, const std::vector<const StudyRun*>& more) {
  runs.insert(runs.end(), more.begin(), more.end());
}

const FigureSpec& partNamed(const Study& study, const std::string& name) {
  const FigureSpec& part = figureNamed(study, name);
  if (std::holds_alternative<CompositeSpec>(part.what))
    throw Error(fmt::format("its part {} is a composite itself", name));
  return part;
}

/// Runs that a measure compares with.
std::vector<const StudyRun*> comparedRuns(const Study& study, const std::vector<const StudyRun*>& runs,
                                          const MeasureSpec& measure) {
  std::vector<const StudyRun*> others;
  if (const auto* difference = std::get_if<DifferenceMeasure>(&measure.what))
    for (const StudyRun* run : runs)
      others.push_back(&runNamed(study, fillIn(difference->other, run->parameters)));
  return others;
}

std::vector<const StudyRun*> runsOfKind(const Study& study, const SetupSpec& spec) {
  return {&runNamed(study, spec.run)};
}

std::vector<const StudyRun*> runsOfKind(const Study& study, const CompositeSpec& spec) {
  std::vector<const StudyRun*> runs;
  for (const std::string& name : spec.figures) append(runs, runsOf(study, partNamed(study, name)));
  return runs;
}

std::vector<const StudyRun*> runsOfKind(const Study& study, const RefinementChartSpec& spec) {
  std::vector<const StudyRun*> runs = study.matching(spec.runs);
  append(runs, comparedRuns(study, runs, spec.measure));
  return runs;
}

template <class Spec>
std::vector<const StudyRun*> runsOfKind(const Study& study, const Spec& spec) {
  return study.matching(spec.runs);
}

/// The number of a parameter's value among all values that any runs of the study give it; runs without the
/// parameter come last.
int valueNumber(const Study& study, const StudyRun& run, const std::string& parameter) {
  std::vector<std::string> values;
  for (const RunsSpec& runs : study.spec.runs)
    for (const ParameterSpec& varied : runs.vary)
      if (varied.name == parameter)
        for (const std::string& value : varied.values)
          if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  const auto own = run.parameters.find(parameter);
  const auto found =
      own == run.parameters.end() ? values.end() : std::find(values.begin(), values.end(), own->second);
  return static_cast<int>(found - values.begin());
}

}  // namespace

std::vector<const StudyRun*> runsOf(const Study& study, const FigureSpec& figure) {
  const auto runs = std::visit([&](const auto& spec) { return runsOfKind(study, spec); }, figure.what);
  return inOrder(study, runs);
}

std::vector<std::filesystem::path> drawFigure(const Study& study, const FigureSpec& figure,
                                              const std::filesystem::path& studyDirectory) {
  const FigureTask task{study, figure, studyDirectory};
  makeDirectory(task.directory());
  try {
    return std::visit([&](const auto& spec) { return drawKind(task, spec); }, figure.what);
  } catch (const Error& error) {
    throw Error(fmt::format("figure {}: {}", figure.name, error.what()));
  }
}

Files drawKind(const FigureTask& task, const SetupSpec& spec) {
  constexpr std::array<int, 2> size{1200, 720};
  const RunData data(runNamed(task.study, spec.run), task.studyDirectory);
  drawSetup(data.result().model(), size, task.file(".png"));
  return {task.file(".png")};
}

Files drawKind(const FigureTask& task, const CompositeSpec& spec) {
  std::vector<SheetPanel> panels;
  for (std::size_t k = 0; k < spec.figures.size(); ++k) {
    const FigureSpec& part = partNamed(task.study, spec.figures[k]);
    const std::filesystem::path picture = task.directory() / (part.name + ".png");
    if (!std::filesystem::exists(picture)) drawFigure(task.study, part, task.studyDirectory);
    panels.push_back({picture, spec.captions.empty() ? std::string() : spec.captions[k]});
  }
  drawSheet(panels, spec.columns, spec.columns * kColumnWidth, task.file(".png"));
  return {task.file(".png")};
}

std::optional<CurveStyle> styleOf(const Study& study, const StudyRun& run, const CurveLooks& looks) {
  if (!looks.color && !looks.dash && !looks.marker) return {};
  CurveStyle style;
  if (looks.color) style.color = valueNumber(study, run, *looks.color);
  if (looks.dash) style.dash = valueNumber(study, run, *looks.dash);
  if (looks.marker) style.marker = valueNumber(study, run, *looks.marker);
  return style;
}

std::string timeText(const std::vector<double>& times, const std::vector<std::string>& labels,
                     std::size_t number) {
  if (!labels.empty()) return labels[number];
  return times[number] == kEndOfRun ? "at the end" : fmt::format("t = {:.4g}", times[number]);
}

std::string withStop(const std::string& text, double stoppedAt) {
  return fmt::format("{} ({})", text, stoppedText(stoppedAt));
}

const FigureSpec& figureNamed(const Study& study, const std::string& name) {
  std::vector<std::string> names;
  for (const FigureSpec& figure : study.spec.figures) {
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw Error(
      fmt::format("{}: there is no figure \"{}\".{}", study.file.string(), name, didYouMean(name, names)));
}

}  // namespace burnish
