#include "postproc/study/figures/surface_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/draw/page/sheet.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"

namespace burnish {
namespace {

/// A contact pair's quantity at the points of the face in their order, which go back where the face folds.
ChartCurve surfaceCurve(const ContactRecord& contact, SurfaceQuantity quantity) {
  const Eigen::VectorXd& values =
      quantity == SurfaceQuantity::Pressure ? contact.quadraturePressure : contact.quadratureGap;
  ChartCurve curve;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    curve.x.push_back(contact.quadraturePoints(0, k));
    curve.y.push_back(values(k));
  }
  return curve;
}

/// The points in a window of x and their neighbours, to which the lines go, so that others do not set the
/// range of y.
ChartCurve within(const ChartCurve& curve, const std::array<double, 2>& window) {
  const auto inside = [&](std::size_t k) {
    return k < curve.x.size() && curve.x[k] >= window[0] && curve.x[k] <= window[1];
  };
  ChartCurve kept{curve.label, {}, {}, curve.style};
  bool interrupted = false;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (!inside(k) && !inside(k + 1) && (k == 0 || !inside(k - 1))) {
      interrupted = !kept.x.empty();
      continue;
    }
    if (interrupted) {
      kept.x.push_back(ChartCurve::kGap);
      kept.y.push_back(ChartCurve::kGap);
      interrupted = false;
    }
    kept.x.push_back(curve.x[k]);
    kept.y.push_back(curve.y[k]);
  }
  return kept;
}

/// What the charts of all times of a surface figure share.
class SurfaceCharts {
 public:
  SurfaceCharts(const FigureTask& task, const SurfaceFigure& spec) : task_(task), spec_(spec) {
    for (const StudyRun* run : task.study.matching(spec.runs)) data_.emplace_back(*run, task.studyDirectory);
    for (const RunData& data : data_) results_.push_back(data.result());
    for (const ResultReader& result : results_)
      if (result.model().dim != 2) throw Error("a surface chart needs two dimensions");
  }

  Chart chart(double time) {
    touched_ = {HUGE_VAL, -HUGE_VAL};
    Chart chart;
    chart.size = {kChartWidth, 2 * kChartWidth / 3};
    const ModelRecord& model = results_.front().model();
    const bool pressure = spec_.quantity == SurfaceQuantity::Pressure;
    chart.x.title = titleWithUnit("x", model.lengthUnit);
    chart.y.title = pressure ? titleWithUnit("contact pressure", model.stressUnit)
                             : titleWithUnit("gap", model.lengthUnit);
    for (std::size_t k = 0; k < data_.size(); ++k) addCurves(chart, k, time);
    chart.x.range = spec_.window ? spec_.window : windowAroundContact();
    if (chart.x.range)
      for (ChartCurve& curve : chart.curves) curve = within(curve, *chart.x.range);
    return chart;
  }

 private:
  static std::string titleWithUnit(const std::string& title, const std::string& unit) {
    return unit.empty() ? title : title + " in " + unit;
  }

  /// A curve for each contact pair of a run; of one that stopped before, only an entry of the legend.
  void addCurves(Chart& chart, std::size_t number, double time) {
    const RunData& data = data_[number];
    const auto style = styleOf(task_.study, data.run(), spec_.looks);
    const FrameAt at = frameAt(data, results_[number], time);
    if (at.stoppedBefore) {
      chart.curves.push_back({withStop(data.run().label, at.frame.time), {}, {}, style});
      return;
    }
    for (const ContactRecord& contact : at.frame.contact) {
      ChartCurve curve = surfaceCurve(contact, spec_.quantity);
      curve.style = style;
      curve.label = at.frame.contact.size() == 1 ? data.run().label
                                                 : fmt::format("{}, {}", data.run().label,
                                                               contact.tool.empty() ? "self" : contact.tool);
      chart.curves.push_back(std::move(curve));
      noteTouched(contact);
    }
  }

  void noteTouched(const ContactRecord& contact) {
    for (Eigen::Index k = 0; k < contact.quadraturePressure.size(); ++k) {
      if (contact.quadraturePressure(k) <= 0.0) continue;
      touched_[0] = std::min(touched_[0], contact.quadraturePoints(0, k));
      touched_[1] = std::max(touched_[1], contact.quadraturePoints(0, k));
    }
  }

  /// The contact of all runs with half its width on either side; nothing without contact.
  std::optional<std::array<double, 2>> windowAroundContact() const {
    const double margin = 0.5 * (touched_[1] - touched_[0]);
    if (!(margin > 0.0)) return {};
    return std::array{touched_[0] - margin, touched_[1] + margin};
  }

  const FigureTask& task_;
  const SurfaceFigure& spec_;
  std::vector<RunData> data_;
  std::vector<ResultReader> results_;
  std::array<double, 2> touched_{};  ///< smallest and largest x with pressure at the time of the chart
};

}  // namespace

Alternative SurfaceFigure::about() {
  return {"surface", "A contact quantity along the contact face, a picture for each time."};
}

void SurfaceFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.requireSameLength(path + ".time_labels", timeLabels.size(), "times", times.size());
}

void SurfaceFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  reporter.checkLooks(path, looks, reporter.runsOf(path + ".runs", runs));
}

void SurfaceFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  const RunReporter::Runs shown = reporter.runsOf(path + ".runs", runs);
  reporter.requirePlane(path + ".runs", "a surface", shown);
  reporter.requireFrames(path + ".times", times, shown);
}

Files SurfaceFigure::draw(const FigureTask& task) const {
  SurfaceCharts charts(task, *this);
  Files files{task.file(".png")};
  std::vector<SheetPanel> panels;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Files made = drawWithData(charts.chart(times[k]), task.file(fmt::format("_t{}.png", k + 1)));
    files.insert(files.end(), made.begin(), made.end());
    panels.push_back({made.front(), timeText(times, timeLabels, k)});
  }
  drawSheet(panels, columns(), columns() * kChartWidth, files.front());
  return files;
}

PrintPage SurfaceFigure::page(const FigureTask& task) const {
  SurfaceCharts charts(task, *this);
  std::vector<PrintPanel> panels;
  for (std::size_t k = 0; k < times.size(); ++k)
    panels.push_back({chartPage(charts.chart(times[k])), timeText(times, timeLabels, k)});
  return printSheet(panels, columns(), columns() * kChartWidth);
}

}  // namespace burnish
