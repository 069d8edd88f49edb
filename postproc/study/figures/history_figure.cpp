#include "postproc/study/figures/history_figure.h"

#include <fmt/format.h>

#include "postproc/draw/page/sheet.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"

namespace burnish {
namespace {

constexpr const char* kOurs = "This program";
constexpr const char* kReference = "Reference";

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
  const std::vector<std::filesystem::path> beside = spec.inputs(task.study.file);
  if (!beside.empty() && beside.front().extension() == ".csv") {
    const HistoryTable points = readHistory(beside.front());
    chart.curves.push_back(scatteredPoints("reference", points.column("x"), points.column("y"),
                                           static_cast<int>(chart.curves.size())));
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

void HistoryFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  const RunReporter::Runs shown = reporter.runsOf(path + ".runs", runs);
  reporter.requireColumns(path + ".x", x, shown);
  reporter.requireColumns(path + ".y", y, shown);
  reporter.requireColumns(path + ".where", where, shown);
}

std::vector<std::filesystem::path> HistoryFigure::inputs(const std::filesystem::path& studyFile) const {
  if (!reference) return {};
  return {studyFile.parent_path() / *reference};
}

std::filesystem::path HistoryFigure::pictureBeside(const FigureTask& task) const {
  const std::vector<std::filesystem::path> files = inputs(task.study.file);
  return files.empty() || files.front().extension() == ".csv" ? std::filesystem::path() : files.front();
}

Files HistoryFigure::draw(const FigureTask& task) const {
  const Chart chart = historyChart(task, *this);
  const std::filesystem::path beside = pictureBeside(task);
  if (beside.empty()) return drawWithData(chart, task.file(".png"));
  drawChart(chart, task.file("_ours.png"));
  writeChartData(chart, task.file(".csv"));
  drawSheet({{task.file("_ours.png"), kOurs}, {beside, kReference}}, 2, 2 * kChartWidth, task.file(".png"));
  return {task.file(".png"), task.file("_ours.png"), task.file(".csv")};
}

PrintPage HistoryFigure::page(const FigureTask& task) const {
  PrintPage chart = chartPage(historyChart(task, *this));
  const std::filesystem::path beside = pictureBeside(task);
  if (beside.empty()) return asColumn(std::move(chart));
  return printSheet({{std::move(chart), kOurs}, {pageOfPicture(beside), kReference}}, 2, 2 * kChartWidth);
}

}  // namespace burnish
