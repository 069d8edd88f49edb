#include "cli/commands/plot_chart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "postproc/study/evidence/expression.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct Run {
  std::string name;
  HistoryTable history;
};

constexpr const char* kHistoryName = "history.csv";

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code status;
  return fs::equivalent(a, b, status);
}

std::vector<Run> readRuns(const PlotArguments& arguments) {
  std::vector<fs::path> files;
  for (const fs::path& path : arguments.histories) files.push_back(historyFile(path));
  const std::vector<std::string> names = runNames(arguments.chart, files, kHistoryName, arguments.histories);
  std::vector<Run> runs;
  for (std::size_t k = 0; k < files.size(); ++k) runs.push_back({names[k], readHistory(files[k])});
  return runs;
}

/// The wanted rows of a history.
ChartCurve rowsOf(const HistoryTable& history, const PlotArguments& arguments, const std::string& formula) {
  const std::vector<double> x = evaluate(history, arguments.x), y = evaluate(history, formula);
  ChartCurve curve;
  curve.label = fmt::format("{}: {} over {}", history.path.string(), formula, arguments.x);
  const std::vector<double> wanted =
      arguments.where.empty() ? std::vector<double>(x.size(), 1.0) : evaluate(history, arguments.where);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (wanted[k] == 0.0 || std::isnan(wanted[k])) continue;
    curve.x.push_back(x[k]);
    curve.y.push_back(y[k]);
  }
  if (curve.x.empty())
    throw Error(arguments.where.empty()
                    ? fmt::format("{}: the history has no rows yet", history.path.string())
                    : fmt::format("{}: no row with {}", history.path.string(), arguments.where));
  return curve;
}

DifferenceKind differenceKind(const std::string& word) {
  return chosen("--difference", word,
                std::array{std::pair{"absolute", DifferenceKind::Absolute},
                           std::pair{"relative", DifferenceKind::Relative}});
}

class ChartMaker {
 public:
  explicit ChartMaker(const PlotArguments& arguments) : arguments_(arguments), runs_(readRuns(arguments)) {
    checkLabels(arguments.chart, runs_.size(), numFormulas() * runs_.size(), "histories");
    if (!arguments.reference.empty()) {
      const fs::path file = historyFile(arguments.reference);
      reference_ = Run{runName(file, kHistoryName), readHistory(file)};
    }
    addAxes();
    addCurves(arguments.y, false);
    addCurves(arguments.y2, true);
    if (made_.chart.curves.empty()) throw Error("--reference: there is no other run to be compared with it");
  }

  PlottedChart take() && { return std::move(made_); }

 private:
  std::size_t numFormulas() const { return arguments_.y.size() + arguments_.y2.size(); }

  void addAxes() {
    made_.chart = emptyChart(arguments_.chart, arguments_.x, axisTitle(arguments_.y));
    made_.chart.y2 = {arguments_.y2Title.empty() ? axisTitle(arguments_.y2) : arguments_.y2Title,
                      arguments_.chart.isLogarithmic("y2"), axisRange("--y2-range", arguments_.y2Range)};
  }

  std::string axisTitle(const std::vector<std::string>& formulas) const {
    const std::string title = fmt::format("{}", fmt::join(formulas, ", "));
    if (!reference_) return areToolForces(formulas) ? title + " (force of the body on the tool)" : title;
    const bool relative = differenceKind(arguments_.difference) == DifferenceKind::Relative;
    return fmt::format("{} of {} from {}", relative ? "relative difference" : "difference", title,
                       reference_->name);
  }

  /// Whether all are columns of forces of tools, whose sign is worth a word. Tools alone have displacements
  /// beside their forces.
  bool areToolForces(const std::vector<std::string>& formulas) const {
    const auto isForce = [](const HistoryTable& history, const std::string& formula) {
      const std::size_t dot = formula.rfind(".f");
      if (dot == std::string::npos || dot + 3 != formula.size()) return false;
      const auto has = [&](const std::string& column) {
        return std::ranges::find(history.columns, column) != history.columns.end();
      };
      return has(formula) && has(formula.substr(0, dot) + ".u" + formula.back());
    };
    return !formulas.empty() && std::ranges::all_of(runs_, [&](const Run& run) {
      return std::ranges::all_of(formulas, [&](const auto& f) { return isForce(run.history, f); });
    });
  }

  void addCurves(const std::vector<std::string>& formulas, bool onRight) {
    for (const std::string& formula : formulas) {
      for (const Run& run : runs_) {
        const std::string label = nextLabel(run, formula);
        if (reference_ && isSameFile(run.history.path, reference_->history.path)) continue;
        ChartCurve curve = rowsOf(run.history, arguments_, formula);
        if (reference_) curve = differenceFromReference(run, formula, curve);
        curve.label = label;
        curve.onRight = onRight;
        made_.chart.curves.push_back(std::move(curve));
      }
    }
  }

  ChartCurve differenceFromReference(const Run& run, const std::string& formula, const ChartCurve& curve) {
    const ChartCurve reference = rowsOf(reference_->history, arguments_, formula);
    made_.differences.push_back(
        {run.name, formula, differenceOf(curve, reference, differenceKind(arguments_.difference))});
    return made_.differences.back().found.curve;
  }

  /// What tells the curve apart from others of its axis: the run, the formula or both.
  std::string nextLabel(const Run& run, const std::string& formula) {
    const std::size_t number = numLabels_++;
    const std::vector<std::string>& given = arguments_.chart.labels;
    if (given.size() > runs_.size()) return given[number];
    const bool axisTellsFormula = arguments_.y.size() == 1 && arguments_.y2.size() <= 1;
    if (runs_.size() == 1 && given.empty() && numFormulas() > 1) return formula;
    if (axisTellsFormula) return run.name;
    return fmt::format("{}: {}", run.name, formula);
  }

  const PlotArguments& arguments_;
  std::vector<Run> runs_;
  std::optional<Run> reference_;
  std::size_t numLabels_ = 0;
  PlottedChart made_;
};

}  // namespace

fs::path historyFile(const fs::path& path) {
  std::error_code status;
  return fs::is_directory(path, status) ? path / kHistoryName : path;
}

PlottedChart chartOf(const PlotArguments& arguments) {
  return ChartMaker(arguments).take();
}

}  // namespace burnish
