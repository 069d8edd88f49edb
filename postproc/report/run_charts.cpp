#include "postproc/report/run_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "postproc/text/markdown.h"
#include "postproc/text/ticks.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

constexpr std::array<int, 2> kSize{640, 400};
constexpr std::size_t kSlowSteps = 5;
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// Charts over the time of a history; what the history does not have is left out.
class HistoryCharts {
 public:
  explicit HistoryCharts(const HistoryTable& history) : history_(history) {}

  using Curves = std::vector<std::pair<std::string, std::string>>;  ///< column, label

  void add(const std::string& caption, const std::string& yTitle, const Curves& curves) {
    CaptionedChart made{caption, {}};
    for (const auto& [column, label] : curves) {
      const auto* values = findColumn(history_, column);
      const auto isSeen = [](double value) { return std::isfinite(value) && value != 0.0; };
      if (values == nullptr || std::none_of(values->begin(), values->end(), isSeen)) continue;
      made.chart.curves.push_back({label, history_.column("time"), *values, {}});
    }
    if (made.chart.curves.empty()) return;
    if (made.chart.curves.size() == 1) made.chart.curves.front().label.clear();
    made.chart.x.title = "time";
    made.chart.y.title = yTitle;
    made.chart.size = kSize;
    charts_.push_back(std::move(made));
  }

  std::vector<CaptionedChart> take() { return std::move(charts_); }

 private:
  const HistoryTable& history_;
  std::vector<CaptionedChart> charts_;
};

/// Residuals of the iterations of one step's last attempt.
struct StepResiduals {
  double time = 0.0;
  std::vector<double> residuals;
};

std::vector<StepResiduals> residualsByStep(const HistoryTable& convergence) {
  std::vector<StepResiduals> steps;
  if (convergence.numRows() == 0) return steps;
  const auto& times = convergence.column("time");
  const auto& iterations = convergence.column("iteration");
  const auto& residuals = convergence.column("residual");
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (iterations[k] == 0.0 || steps.empty()) steps.push_back({times[k], {}});
    steps.back().residuals.push_back(residuals[k] > 0.0 ? residuals[k] : kGap);  // a logarithm is taken
  }
  return steps;
}

/// A curve over time that has a value for each step.
template <class Value>
ChartCurve curveOfSteps(const std::string& label, const std::vector<StepResiduals>& steps,
                        const Value& value) {
  ChartCurve curve{label, {}, {}, {}};
  for (const StepResiduals& step : steps) {
    curve.x.push_back(step.time);
    curve.y.push_back(value(step));
  }
  return curve;
}

Chart chartOf(const std::string& xTitle, const std::string& yTitle, std::vector<ChartCurve> curves) {
  Chart chart;
  chart.x.title = xTitle;
  chart.y.title = yTitle;
  chart.curves = std::move(curves);
  chart.size = kSize;
  return chart;
}

CaptionedChart iterationsChart(const HistoryTable& history, const std::vector<StepResiduals>& steps) {
  ChartCurve all{"with failed attempts", history.column("time"), history.column("newton_iterations"),
                 CurveStyle{1, 0, -1}};
  all.x.erase(all.x.begin());  // the start is no step
  all.y.erase(all.y.begin());
  ChartCurve last = curveOfSteps("of the attempt that converged", steps, [](const StepResiduals& step) {
    return static_cast<double>(step.residuals.size()) - 1.0;
  });
  last.style = CurveStyle{0, 0, -1};
  const double most = *std::max_element(all.y.begin(), all.y.end());
  std::vector<ChartCurve> curves{std::move(all)};
  if (!last.x.empty()) curves.push_back(std::move(last));
  CaptionedChart made{"Newton iterations of each step", chartOf("time", "iterations", std::move(curves))};
  made.chart.y.range = {0.0, std::max(5.0, 1.1 * most)};
  return made;
}

CaptionedChart stepsChart(const RunRecord& run) {
  const std::vector<double>& times = run.history.column("time");
  ChartCurve curve{"", {}, {}, CurveStyle{0, 0, -1}};
  for (std::size_t k = 1; k < times.size(); ++k) {
    curve.x.insert(curve.x.end(), {times[k - 1], times[k]});
    curve.y.insert(curve.y.end(), 2, times[k] - times[k - 1]);
  }
  CaptionedChart made{
      run.account ? fmt::format("Step size; {} cut-backs halved a step", run.account->cuts) : "Step size",
      chartOf("time", "step size", {std::move(curve)})};
  made.chart.y.logarithmic = true;
  return made;
}

CaptionedChart endResidualsChart(const RunRecord& run, const std::vector<StepResiduals>& steps) {
  ChartCurve residuals =
      curveOfSteps("residual", steps, [](const StepResiduals& step) { return step.residuals.back(); });
  residuals.style = CurveStyle{0, 0, -1};
  CaptionedChart made{"Relative residual at the end of each step",
                      chartOf("time", "relative residual", {std::move(residuals)})};
  if (run.account)
    made.chart.curves.push_back({"tolerance",
                                 {steps.front().time, steps.back().time},
                                 {run.account->tolerance, run.account->tolerance},
                                 CurveStyle{1, 1, -1}});
  made.chart.y.logarithmic = true;
  return made;
}

CaptionedChart slowestStepsChart(std::vector<StepResiduals> steps) {
  std::stable_sort(steps.begin(), steps.end(), [](const StepResiduals& a, const StepResiduals& b) {
    return a.residuals.size() > b.residuals.size();
  });
  steps.resize(std::min(steps.size(), kSlowSteps));
  CaptionedChart made{"Residuals of the steps that took most iterations",
                      chartOf("iteration", "relative residual", {})};
  for (StepResiduals& step : steps) {
    ChartCurve curve{"t = " + plainNumber(step.time), {}, std::move(step.residuals), {}};
    for (std::size_t k = 0; k < curve.y.size(); ++k) curve.x.push_back(static_cast<double>(k));
    made.chart.curves.push_back(std::move(curve));
  }
  made.chart.y.logarithmic = true;
  return made;
}

/// Residuals of exactly zero, of a body on which nothing acts, have no place on a logarithmic axis.
bool hasPoints(const ChartCurve& curve) {
  return std::any_of(curve.y.begin(), curve.y.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

std::vector<CaptionedChart> stateCharts(const RunRecord& run) {
  const ModelRecord& model = run.result.model();
  HistoryCharts charts(run.history);
  const std::string depth = model.dim == 2 && !isAxisymmetric(model) ? " (per unit of depth)" : "";
  const DerivedUnits units = derivedUnits(model);
  const auto addForce = [&](const char* kind, const std::string& name) {
    charts.add(fmt::format("Force of the body on the {} “{}”{}", kind, name, depth),
               withUnit(fmt::format("force of the body on the {}", kind), units.force),
               {{name + ".fx", "x"}, {name + ".fy", "y"}, {name + ".fz", "z"}});
  };
  for (const ToolRecord& tool : model.tools) addForce("tool", tool.name);
  if (run.account)
    for (const ReactionRecord& reaction : run.account->reactions) addForce("support", reaction.support);
  charts.add("Energies and work" + depth, withUnit("energy", units.energy),
             {{"strain_energy", "strain energy"},
              {"contact_energy", "contact energy"},
              {"external_work", "external work"},
              {"plastic_work", "plastic work"}});
  charts.add("Equivalent plastic strain", "plastic strain",
             {{"max_plastic_strain", "largest, quadrature points"},
              {"max_plastic_strain_projected", "largest, projected"},
              {"min_plastic_strain_projected", "smallest, projected"}});
  charts.add("Largest point-wise penetration", withUnit("penetration", units.length),
             {{"max_penetration", "largest penetration"}});
  charts.add("Smallest volume ratio J", "J", {{"min_detJ", "smallest J"}});
  return charts.take();
}

std::vector<CaptionedChart> convergenceCharts(const RunRecord& run) {
  std::vector<CaptionedChart> charts;
  const std::vector<StepResiduals> steps = residualsByStep(run.convergence);
  if (findColumn(run.history, "newton_iterations") != nullptr && run.history.numRows() > 1)
    charts.push_back(iterationsChart(run.history, steps));
  if (run.history.numRows() > 1) charts.push_back(stepsChart(run));
  if (steps.empty()) return charts;
  for (CaptionedChart& chart : std::array{endResidualsChart(run, steps), slowestStepsChart(steps)})
    if (hasPoints(chart.chart.curves.front())) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace burnish
