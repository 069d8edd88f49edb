#include "cli/commands/plot_chart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "engine/analysis/history_columns.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/model_io.h"
#include "engine/results/result_files.h"
#include "postproc/study/evidence/expression.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct Run {
  std::string name;
  HistoryTable history;
  std::optional<std::vector<std::string>> tools;  ///< their names, where the result stands beside the history
  DerivedUnits units;
};

constexpr const char* kHistoryName = "history.csv";

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code status;
  return fs::equivalent(a, b, status);
}

/// A history with what the result beside it says of its columns. One that cannot be read only costs words.
Run readRun(std::string name, const fs::path& file) {
  Run run{std::move(name), readHistory(file), {}, {}};
  std::error_code status;
  const fs::path result = modelFile(file.parent_path());
  if (file.filename() != kHistoryName || !fs::exists(result, status)) return run;
  try {
    const ModelRecord model = readModel(result).record;
    run.tools.emplace();
    for (const ToolRecord& tool : model.tools) run.tools->push_back(tool.name);
    run.units = derivedUnits(model);
  } catch (const Error&) {
    run.tools.reset();
  }
  return run;
}

/// A formula in words, if it is a column that they are known of, with the unit; the kind of quantity, of
/// which there may be several on an axis, is empty for plain numbers.
struct Worded {
  std::string words, kind, unit;
};

Worded worded(const Run& run, const std::string& formula) {
  const auto& columns = run.history.columns;
  if (std::ranges::find(columns, formula) == columns.end()) return {formula, "", ""};
  const auto meaning = columnMeaning(formula, columns, run.tools);
  if (!meaning) return {formula, "", ""};
  switch (meaning->measured) {
    case Measured::Number:
      return {meaning->words, "", ""};
    case Measured::Length:
      return {meaning->words, "Length", run.units.length};
    case Measured::Degrees:
      return {meaning->words, "Turn", "°"};
    case Measured::Area:
      return {meaning->words, "Area", run.units.area};
    case Measured::Force:
      return {meaning->words, "Force", run.units.force};
    case Measured::Moment:
      return {meaning->words, "Moment", run.units.energy};
    case Measured::Energy:
      return {meaning->words, "Energy", run.units.energy};
  }
  std::abort();
}

std::vector<Run> readRuns(const PlotArguments& arguments) {
  std::vector<fs::path> files;
  for (const fs::path& path : arguments.histories) files.push_back(historyFile(path));
  const std::vector<std::string> names = runNames(arguments.chart, files, kHistoryName, arguments.histories);
  std::vector<Run> runs;
  for (std::size_t k = 0; k < files.size(); ++k) runs.push_back(readRun(names[k], files[k]));
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
      reference_ = readRun(runName(file, kHistoryName), file);
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
    made_.chart = emptyChart(arguments_.chart, titleOf({arguments_.x}), axisTitle(arguments_.y));
    made_.chart.y2 = {arguments_.y2Title.empty() ? axisTitle(arguments_.y2) : arguments_.y2Title,
                      arguments_.chart.isLogarithmic("y2"), axisRange("--y2-range", arguments_.y2Range)};
  }

  /// A formula in words with its unit, as far as they are the same for all runs; of several what all of them
  /// are, or one behind the other if they are few.
  std::string titleOf(const std::vector<std::string>& formulas) const {
    std::vector<Worded> all;
    for (const std::string& formula : formulas)
      for (const Run& run : runs_) all.push_back(worded(run, formula));
    if (all.empty()) return "";
    const auto haveOne = [&](std::string Worded::*member) {
      return std::ranges::all_of(all,
                                 [&](const Worded& each) { return each.*member == all.front().*member; });
    };
    const std::string unit = haveOne(&Worded::unit) ? all.front().unit : "";
    if (haveOne(&Worded::words)) return withUnit(all.front().words, unit);
    if (haveOne(&Worded::kind) && !all.front().kind.empty()) return withUnit(all.front().kind, unit);
    constexpr std::size_t kMostNamed = 3;  // of more the legend tells, beside an axis they would be tiny
    if (formulas.size() > kMostNamed) return unit.empty() ? "" : fmt::format("[{}]", unit);
    return fmt::format("{}", fmt::join(formulas, ", "));
  }

  std::string axisTitle(const std::vector<std::string>& formulas) const {
    if (!reference_) return titleOf(formulas);
    const bool relative = differenceKind(arguments_.difference) == DifferenceKind::Relative;
    return fmt::format("{} of {} from {}", relative ? "relative difference" : "difference",
                       fmt::join(formulas, ", "), reference_->name);
  }

  void addCurves(const std::vector<std::string>& formulas, bool onRight) {
    for (const std::string& formula : formulas) {
      for (const Run& run : runs_) {
        const std::size_t number = numLabels_++;
        if (reference_ && isSameFile(run.history.path, reference_->history.path)) continue;
        ChartCurve curve = rowsOf(run.history, arguments_, formula);
        if (reference_) curve = differenceFromReference(run, formula, curve);
        curve.label = labelOf(run, formula, number);
        made_.legend.push_back(labelOf(run, worded(run, formula).words, number));
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

  /// What tells the curve apart from others of its axis: the run, what it shows or both.
  std::string labelOf(const Run& run, const std::string& shown, std::size_t number) const {
    const std::vector<std::string>& given = arguments_.chart.labels;
    if (given.size() > runs_.size()) return given[number];
    const bool axisTellsFormula = arguments_.y.size() == 1 && arguments_.y2.size() <= 1;
    if (runs_.size() == 1 && given.empty() && numFormulas() > 1) return shown;
    if (axisTellsFormula) return run.name;
    return fmt::format("{}: {}", run.name, shown);
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
