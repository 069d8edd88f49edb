#include "postproc/study/figures/probe_figure.h"

#include <fmt/format.h>

#include <numeric>

#include "postproc/probe/probed_run.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

/// What a run has at each time, named by the run, and by the time if there are several.
std::vector<ProbedRun> atTimes(const RunData& data, const ProbeFigure& spec) {
  const ResultReader result = data.result();
  const std::vector<double> times = spec.times.empty() ? std::vector{kEndOfRun} : spec.times;
  std::vector<ProbedRun> runs;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const FrameAt at = frameAt(data, result, times[k]);
    ProbedRun& run = runs.emplace_back(probedFrame(result.model(), at.frame, spec.probe));
    run.name = data.run().label;
    if (times.size() > 1) run.name += ", " + timeText(times, spec.timeLabels, k);
    if (at.stoppedBefore) run.name = withStop(run.name, at.frame.time);
  }
  return runs;
}

ProbedRun overTime(const RunData& data, const ProbeFigure& spec) {
  const ResultReader result = data.result();
  std::vector<int> frames(static_cast<std::size_t>(result.numFrames()));
  std::iota(frames.begin(), frames.end(), 0);
  ProbedRun run = probedHistory(result, frames, spec.probe);
  const auto stopped = data.stoppedAt();
  run.name = stopped ? withStop(data.run().label, *stopped) : data.run().label;
  return run;
}

struct ProbedChart {
  std::vector<ProbedRun> probed;
  Chart chart;
};

ProbedChart probedChart(const FigureTask& task, const ProbeFigure& spec) {
  std::vector<ProbedRun> probed;
  std::vector<std::optional<CurveStyle>> styles;
  for (const StudyRun* run : task.study.matching(spec.runs)) {
    const RunData data(*run, task.studyDirectory);
    for (ProbedRun& found :
         spec.probe.isOverTime() ? std::vector{overTime(data, spec)} : atTimes(data, spec)) {
      probed.push_back(std::move(found));
      styles.push_back(styleOf(task.study, *run, spec.looks));
    }
  }
  // Looks tell runs apart; where a run has several curves, these have looks by their number.
  const bool onePerRun = spec.times.size() < 2 && spec.probe.fields.size() < 2;
  Chart chart = chartOf(spec.probe, probed);
  if (onePerRun)
    for (std::size_t k = 0; k < chart.curves.size(); ++k) chart.curves[k].style = styles[k];
  return {std::move(probed), std::move(chart)};
}

}  // namespace

Alternative ProbeFigure::about() {
  return {"probe", "Exact values along a path in the bodies, or over time at a point of the material."};
}

void ProbeFigure::check(const std::string& path, const StudyReporter& reporter) const {
  for (const InputProblem& problem : conflictsIn(probe))
    reporter.report(path + "." + problem.path, problem.text);
  reporter.requireSameLength(path + ".time_labels", timeLabels.size(), "times", times.size());
  if (probe.isOverTime() && !times.empty())
    reporter.report(path + ".times", "found times of values over time; allowed: none.");
}

void ProbeFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.checkLooks(path, looks, reporter.runsOf(path + ".runs", runs));
}

void ProbeFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  const RunReporter::Runs shown = reporter.runsOf(path + ".runs", runs);
  for (std::size_t k = 0; k < probe.fields.size(); ++k)
    reporter.requireField(fmt::format("{}.field[{}]", path, k), probe.fields[k], shown);
  reporter.requireBodies(path + ".body", probe.bodies, shown);
  reporter.requireFrames(path + ".times", times, shown);
}

Files ProbeFigure::draw(const FigureTask& task) const {
  const ProbedChart made = probedChart(task, *this);
  const Files files{task.file(".png"), task.file(".csv")};
  drawChart(made.chart, files[0]);
  writeText(tableOf(probe, made.probed), files[1]);
  return files;
}

PrintPage ProbeFigure::page(const FigureTask& task) const {
  return asColumn(chartPage(probedChart(task, *this).chart));
}

}  // namespace burnish
