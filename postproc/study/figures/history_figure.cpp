#include "postproc/study/figures/history_figure.h"

#include <fmt/format.h>

#include "postproc/draw/page/sheet.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/study/run_data.h"
#include "postproc/study/study_reporter.h"

namespace burnish {
namespace {

/// Points without a line between them: a gap follows each.
ChartCurve scatteredPoints(const std::string& label, const std::vector<double>& x,
                           const std::vector<double>& y, int number) {
  ChartCurve curve{label, {}, {}, CurveStyle{number, 0, number}};
  for (std::size_t k = 0; k < x.size(); ++k) {
    curve.x.insert(curve.x.end(), {x[k], ChartCurve::kGap});
    curve.y.insert(curve.y.end(), {y[k], ChartCurve::kGap});
  }
  return curve;
}

Chart historyChart(const FigureTask& task, const HistoryFigure& spec) {
  Chart chart;
  chart.x.title = spec.xTitle.empty() ? spec.x : spec.xTitle;
  chart.y.title = spec.yTitle.empty() ? spec.y : spec.yTitle;
  for (const StudyRun* run : task.study.matching(spec.runs)) {
    const RunData data(*run, task.studyDirectory);
    const Series series = seriesOf(data.history(), spec.x, spec.y, spec.where);
    const auto stopped = data.stoppedAt();
    chart.curves.push_back({stopped ? withStop(run->label, *stopped) : run->label, series.x, series.y,
                            styleOf(task.study, *run, spec.looks)});
  }
  return chart;
}

}  // namespace

Alternative HistoryFigure::about() {
  return {"history", "Curves y(x) from the histories, one for each run."};
}

void HistoryFigure::check(const std::string& path, const StudyReporter& reporter) const {
  if (reference && !reference->ends_with(".png") && !reference->ends_with(".csv"))
    reporter.report(path + ".reference",
                    fmt::format("found {}; allowed: a file with the ending .png or .csv.", *reference));
}

void HistoryFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.checkLooks(path, looks, reporter.runsOf(path + ".runs", runs));
  if (reference && !std::filesystem::exists(inputs(reporter.study().file).front()))
    reporter.report(path + ".reference",
                    fmt::format("found {}, but there is no such file beside the study file.", *reference));
}

std::vector<std::filesystem::path> HistoryFigure::inputs(const std::filesystem::path& studyFile) const {
  if (!reference) return {};
  return {studyFile.parent_path() / *reference};
}

Files HistoryFigure::draw(const FigureTask& task) const {
  Chart chart = historyChart(task, *this);
  if (!reference) return drawWithData(chart, task.file(".png"));
  const std::filesystem::path file = inputs(task.study.file).front();
  if (file.extension() == ".csv") {
    const HistoryTable points = readHistory(file);
    chart.curves.push_back(scatteredPoints("reference", points.column("x"), points.column("y"),
                                           static_cast<int>(chart.curves.size())));
    return drawWithData(chart, task.file(".png"));
  }
  drawChart(chart, task.file("_ours.png"));
  writeChartData(chart, task.file(".csv"));
  drawSheet({{task.file("_ours.png"), "This program"}, {file, "Reference"}}, 2, 2 * kChartWidth,
            task.file(".png"));
  return {task.file(".png"), task.file("_ours.png"), task.file(".csv")};
}

}  // namespace burnish
