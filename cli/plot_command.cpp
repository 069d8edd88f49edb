#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "postproc/draw/chart.h"
#include "postproc/study/expression.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::vector<fs::path> histories;
  fs::path picture;
  std::string x = "time", y = "strain_energy", where;
  std::string title, xTitle, yTitle;
  std::string log, size;
  std::vector<std::string> labels;
  fs::path csv;
};

/// DIR/history.csv for the directory of a run, else the file itself.
fs::path historyFile(const fs::path& path) {
  std::error_code status;
  return fs::is_directory(path, status) ? path / "history.csv" : path;
}

/// The name of the directory of a run, or of the file if it has another name than that of a run.
std::string defaultLabel(const fs::path& history) {
  if (history.filename() != "history.csv") return history.stem().string();
  std::error_code status;
  const std::string directory = fs::weakly_canonical(history, status).parent_path().filename().string();
  return directory.empty() ? history.stem().string() : directory;
}

ChartCurve curveOf(const PlotArguments& arguments, std::size_t number) {
  const HistoryTable history = readHistory(historyFile(arguments.histories[number]));
  const std::vector<double> x = evaluate(history, arguments.x), y = evaluate(history, arguments.y);
  ChartCurve curve;
  curve.label = arguments.labels.empty() ? defaultLabel(history.path) : arguments.labels[number];
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

ExitCode plot(const PlotArguments& arguments) {
  const std::size_t count = arguments.histories.size();
  if (!arguments.labels.empty() && arguments.labels.size() != count)
    throw Error(fmt::format("--label: found {} labels for {} histories; expected one for each",
                            arguments.labels.size(), count));
  Chart chart;
  chart.title = arguments.title;
  chart.x = {.title = arguments.xTitle.empty() ? arguments.x : arguments.xTitle,
             .logarithmic = arguments.log.starts_with('x'),
             .range = {}};
  chart.y = {.title = arguments.yTitle.empty() ? arguments.y : arguments.yTitle,
             .logarithmic = arguments.log.ends_with('y'),
             .range = {}};
  if (!arguments.size.empty()) chart.size = sizeFromText(arguments.size);
  for (std::size_t k = 0; k < count; ++k) chart.curves.push_back(curveOf(arguments, k));
  makeDirectoryOf(arguments.picture);
  drawChart(chart, arguments.picture);
  if (!arguments.csv.empty()) writeChartData(chart, arguments.csv);
  return ExitCode::Fine;
}

}  // namespace

void addPlotCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("plot", "Draw a chart of histories");
  const auto arguments = std::make_shared<PlotArguments>();
  command->add_option("HISTORY", arguments->histories, "Directories of runs or CSV files, one curve each")
      ->required();
  command
      ->add_option("--x", arguments->x,
                   "Column or formula in columns along the x axis, such as \"time - 1\" [time]")
      ->type_name("EXPR");
  command->add_option("--y", arguments->y, "The same along the y axis [strain_energy]")->type_name("EXPR");
  command
      ->add_option("--where", arguments->where,
                   "Rows to draw: those where a formula such as \"time >= 1\" is true [all]")
      ->type_name("EXPR");
  command->add_option("--x-title", arguments->xTitle, "Title of the x axis [the formula]")->type_name("TEXT");
  command->add_option("--y-title", arguments->yTitle, "Title of the y axis [the formula]")->type_name("TEXT");
  command->add_option("--title", arguments->title, "Title of the chart [none]")->type_name("TEXT");
  command->add_option("--log", arguments->log, "Logarithmic axes: x, y or xy [none]")
      ->check(CLI::IsMember({"x", "y", "xy"}))
      ->type_name("AXES");
  command
      ->add_option("--label", arguments->labels,
                   "Name of a curve in the legend, once per history [name of the directory]")
      ->expected(1)
      ->take_all()
      ->type_name("TEXT");
  command->add_option("--csv", arguments->csv, "Write the drawn points to this file too")
      ->type_name("FILE.csv");
  command->add_option("--size", arguments->size, "Size in pixels, or in points for SVG and PDF [1200,900]")
      ->type_name("W,H");
  command->add_option("-o,--output", arguments->picture, "Name of the chart")
      ->type_name("CHART.png|svg|pdf")
      ->required();
  command->callback([&action, arguments] { action = [arguments] { return plot(*arguments); }; });
}

}  // namespace burnish
