#include "postproc/study/figures/refinement_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "postproc/study/evidence/reductions.h"
#include "postproc/study/evidence/refinement.h"
#include "postproc/study/measures.h"
#include "postproc/study/run_data.h"
#include "postproc/study/run_outlook.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

struct RefinedRun {
  const StudyRun* run;
  double functions = 0.0;
  MeshValue mesh;
};

/// Runs that differ in nothing but the mesh, coarse to fine.
struct RefinementCurve {
  std::string label;
  std::vector<RefinedRun> runs;
  std::optional<double> limit;  ///< extrapolated from its own finest three meshes
};

/// Labels of a run's parameters but one; of parameters without labels their name and value.
std::string labelWithout(const Study& study, const StudyRun& run, const std::string& left) {
  std::string label;
  std::vector<std::string> named;
  for (const RunsSpec& runs : study.spec.runs)
    for (const ParameterSpec& parameter : runs.vary) {
      const auto value = run.parameters.find(parameter.name);
      if (parameter.name == left || value == run.parameters.end()) continue;
      if (std::find(named.begin(), named.end(), parameter.name) != named.end()) continue;
      named.push_back(parameter.name);
      const std::string text = parameter.labels.empty() ? fmt::format("{} {}", parameter.name, value->second)
                                                        : run.parameters.at(parameter.name + ".label");
      label += (label.empty() ? "" : ", ") + text;
    }
  return label;
}

/// A size of the cells that fits the number of functions.
double sizeOf(double functions, int dim) {
  return std::pow(functions, -1.0 / dim);
}

std::optional<RefinedRun> refinedRun(const FigureTask& task, const StudyRun& run,
                                     const MeasureSpec& measure) {
  const RunData data(run, task.studyDirectory);
  const auto value = evaluateMeasure(task.study, run, measure, task.studyDirectory).comparable();
  if (!value) return {};
  const double functions = data.number("functions");
  return RefinedRun{&run, functions, {sizeOf(functions, data.result().model().dim), *value}};
}

/// Runs without a value, such as those that stopped early, are left out.
std::vector<RefinementCurve> refinementCurves(const FigureTask& task, const RefinementFigure& spec) {
  std::vector<RefinementCurve> curves;
  for (const StudyRun* run : task.study.matching(spec.runs)) {
    const auto refined = refinedRun(task, *run, spec.measure);
    if (!refined) continue;
    const std::string label = labelWithout(task.study, *run, spec.refine);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.label == label; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), {label, {}, {}});
    curve->runs.push_back(*refined);
  }
  for (RefinementCurve& curve : curves) {
    auto& runs = curve.runs;
    std::stable_sort(runs.begin(), runs.end(),
                     [](const RefinedRun& a, const RefinedRun& b) { return a.functions < b.functions; });
    const std::size_t n = runs.size();
    if (n >= 3) curve.limit = extrapolatedLimit({runs[n - 3].mesh, runs[n - 2].mesh, runs[n - 1].mesh});
  }
  return curves;
}

/// "NURBS: 0.25, 0.39, 0.18; …".
std::string valuesText(const std::vector<RefinementCurve>& curves) {
  std::string text;
  for (const RefinementCurve& curve : curves) {
    text += (text.empty() ? "" : "; ") + (curve.label.empty() ? "" : curve.label + ": ");
    for (std::size_t k = 0; k < curve.runs.size(); ++k)
      text += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", curve.runs[k].mesh.value);
  }
  return text.empty() ? "none" : text;
}

/// What all curves tend to, and how far their own limits are from it.
struct CommonLimit {
  double value;    ///< median over the curves
  double scatter;  ///< median of |limit of a curve - value|
};

CommonLimit commonLimit(const std::vector<RefinementCurve>& curves) {
  std::vector<double> limits, distances;
  for (const RefinementCurve& curve : curves)
    if (curve.limit) limits.push_back(*curve.limit);
  const auto value = median(limits);
  if (!value)
    throw Error(
        fmt::format("no limit can be extrapolated: at least one curve needs three meshes whose values come "
                    "closer to each other as with an order of 0.85 or more; found {}",
                    valuesText(curves)));
  for (const double limit : limits) distances.push_back(std::abs(limit - *value));
  return {*value, median(distances).value_or(0.0)};
}

/// The slope of the least-squares line through the meshes whose errors are larger than what is known of the
/// limit.
std::optional<double> orderOf(const RefinementCurve& curve, const CommonLimit& limit) {
  std::vector<MeshValue> meshes;
  for (const RefinedRun& run : curve.runs)
    if (std::abs(run.mesh.value - limit.value) > limit.scatter) meshes.push_back(run.mesh);
  return meanOrder(meshes, limit.value);
}

/// Part of the limit, or the difference itself where the limit is zero.
double errorOf(const RefinedRun& run, double limit) {
  const double difference = std::abs(run.mesh.value - limit);
  return limit == 0.0 ? difference : difference / std::abs(limit);
}

ChartCurve chartCurve(const FigureTask& task, const RefinementFigure& spec, const RefinementCurve& curve,
                      const CommonLimit& limit) {
  ChartCurve drawn;
  const auto order = orderOf(curve, limit);
  const std::string label = curve.label.empty() ? spec.measure.title : curve.label;
  drawn.label = order ? fmt::format("{} (order {:.1f})", label, *order) : label;
  drawn.style = styleOf(task.study, *curve.runs.front().run, spec.looks);
  if (drawn.style && drawn.style->marker < 0) drawn.style->marker = drawn.style->color;
  for (const RefinedRun& run : curve.runs) {
    const double error = errorOf(run, limit.value);
    drawn.x.push_back(run.functions);
    drawn.y.push_back(error > 0.0 ? error : std::nan(""));  // a logarithmic axis has no zero
  }
  return drawn;
}

/// Errors below it are not known, because the limits of the curves differ by so much.
ChartCurve scatterLine(const std::vector<ChartCurve>& curves, const CommonLimit& limit) {
  double low = HUGE_VAL, high = 0.0;
  for (const ChartCurve& curve : curves)
    for (const double x : curve.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  const double error = limit.value == 0.0 ? limit.scatter : limit.scatter / std::abs(limit.value);
  return {
      .label = "scatter of the limits", .x = {low, high}, .y = {error, error}, .style = CurveStyle{3, 2, -1}};
}

Chart refinementChart(const FigureTask& task, const RefinementFigure& spec,
                      const std::vector<RefinementCurve>& curves, const CommonLimit& limit) {
  Chart chart;
  chart.size = {1200, 1200};  // room for the legend, which has the orders in it
  chart.x = {"number of basis functions", true, {}};
  chart.y = {spec.yTitle.empty() ? "relative error of " + spec.measure.title : spec.yTitle, true, {}};
  for (const RefinementCurve& curve : curves) chart.curves.push_back(chartCurve(task, spec, curve, limit));
  if (limit.scatter > 0.0) chart.curves.push_back(scatterLine(chart.curves, limit));
  return chart;
}

std::string numberCell(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

std::string dataText(const std::vector<RefinementCurve>& curves, double limit) {
  std::string text =
      csvRow({"run", "functions", "value", "relative_error", "order", "limit_of_curve", "limit"}) + "\n";
  for (const RefinementCurve& curve : curves)
    for (std::size_t k = 0; k < curve.runs.size(); ++k) {
      const RefinedRun& run = curve.runs[k];
      const auto order = k == 0 ? std::nullopt : observedOrder(curve.runs[k - 1].mesh, run.mesh, limit);
      text += csvRow({run.run->name, numberCell(run.functions), numberCell(run.mesh.value),
                      numberCell(errorOf(run, limit)), numberCell(order), numberCell(curve.limit),
                      numberCell(limit)}) +
              "\n";
    }
  return text;
}

}  // namespace

Alternative RefinementFigure::about() {
  return {"refinement", "Error of a measure against the number of basis functions, log-log."};
}

void RefinementFigure::check(const std::string& path, const StudyReporter& reporter) const {
  reporter.checkMeasure(path + ".measure", measure);
}

void RefinementFigure::checkReferences(const std::string& path, const RunReporter& reporter) const {
  const RunReporter::Runs shown = reporter.runsOf(path + ".runs", runs);
  reporter.checkLooks(path, looks, shown);
  for (const StudyRun* run : shown)
    if (!run->parameters.contains(refine)) return reporter.requireParameter(path + ".refine", refine, {run});
  reporter.checkReferences(path + ".measure", measure, shown);
}

void RefinementFigure::checkOutlooks(const std::string& path, const OutlookReporter& reporter) const {
  reporter.requireMeasure(path + ".measure", measure, reporter.runsOf(path + ".runs", runs));
}

std::vector<const StudyRun*> RefinementFigure::shownRuns(const Study& study) const {
  std::vector<const StudyRun*> shown = study.matching(runs);
  const auto* difference = std::get_if<DifferenceMeasure>(&measure.what);
  if (difference == nullptr) return shown;
  std::vector<const StudyRun*> compared;
  for (const StudyRun* run : shown)
    compared.push_back(&runNamed(study, fillIn(difference->other, run->parameters)));
  shown.insert(shown.end(), compared.begin(), compared.end());
  return shown;
}

Files RefinementFigure::draw(const FigureTask& task) const {
  const std::vector<RefinementCurve> curves = refinementCurves(task, *this);
  const CommonLimit limit = commonLimit(curves);
  drawChart(refinementChart(task, *this, curves, limit), task.file(".png"));
  writeText(dataText(curves, limit.value), task.file(".csv"));
  return {task.file(".png"), task.file(".csv")};
}

PrintPage RefinementFigure::page(const FigureTask& task) const {
  const std::vector<RefinementCurve> curves = refinementCurves(task, *this);
  return asColumn(chartPage(refinementChart(task, *this, curves, commonLimit(curves))));
}

}  // namespace burnish
