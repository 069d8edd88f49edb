#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/plot_chart.h"
#include "cli/console.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

std::string differenceText(const LargestDifference& difference, const std::string& x) {
  const CurveDifference& found = difference.found;
  const std::string share = found.referenceMagnitude > 0.0
                                ? fmt::format(" ({:.3g} %)", 100.0 * found.largest / found.referenceMagnitude)
                                : "";
  return fmt::format("{}: largest difference of {}: {:.6g}{} at {} = {:.6g}\n", difference.run, difference.y,
                     found.largest, share, x, found.largestAt);
}

/// How the rows are left out that a logarithmic axis does not show; empty for other mistakes.
std::string whereHint(const Error& error, const PlotArguments& arguments) {
  const std::string text = error.what();
  if (!text.starts_with("log: ")) return "";
  const bool ofX = text.find("\" has x = ") != std::string::npos;
  const std::string formula = ofX                                             ? arguments.x
                              : arguments.y.size() + arguments.y2.size() == 1 ? arguments.y.front()
                                                                              : "EXPR";
  return fmt::format("; --where {} leaves other rows out", shellWord(formula + " > 0"));
}

ExitCode plot(const PlotArguments& arguments, const ChartOutputs& outputs) {
  std::vector<std::filesystem::path> inputs;
  for (const std::filesystem::path& path : arguments.histories) inputs.push_back(historyFile(path));
  if (!arguments.reference.empty()) inputs.push_back(historyFile(arguments.reference));
  checkOutputs(outputs, std::move(inputs));
  const PlottedChart plotted = chartOf(arguments);
  if (!outputs.picture.empty()) {
    Chart chart = plotted.chart;
    for (std::size_t k = 0; k < chart.curves.size(); ++k) chart.curves[k].label = plotted.legend[k];
    // What a single curve is, the axis says.
    chart.legend = chart.curves.size() > 1 || !arguments.chart.labels.empty();
    try {
      writePicture(chart, outputs);
    } catch (const Error& error) {
      throw Error(error.what() + whereHint(error, arguments));
    }
  }
  if (outputs.printsData())
    printText(chartDataText(plotted.chart));
  else if (!outputs.csv.empty())
    writeChartData(plotted.chart, outputs.csv);
  for (const LargestDifference& difference : plotted.differences)
    if (outputs.printsData() || outputs.printsPicture())
      printErrorText(differenceText(difference, arguments.x));
    else
      printText(differenceText(difference, arguments.x));
  return ExitCode::Fine;
}

void addDataOptions(CLI::App& command, PlotArguments& arguments) {
  command
      .add_option("HISTORY", arguments.histories,
                  "Directories of runs or CSV files, one curve each per formula")
      ->required();
  command
      .add_option("--x", arguments.x,
                  "Column or formula in columns along the x axis, such as \"time - 1\" [time]")
      ->type_name("EXPR");
  const auto addFormulas = [&](const char* name, std::vector<std::string>& formulas, const char* help) {
    return command.add_option(name, formulas, help)->expected(1)->take_all()->type_name("EXPR");
  };
  addFormulas("--y", arguments.y, "The same along the y axis, once or several times [strain_energy]");
  addFormulas("--y2", arguments.y2, "The same along a second y axis at the right [none]");
  command
      .add_option("--where", arguments.where,
                  "Rows to draw: those where a formula such as \"time >= 1\" is true [all]")
      ->type_name("EXPR");
  CLI::Option* reference = command
                               .add_option("--reference", arguments.reference,
                                           "Draw the differences from this run, and print the largest [none]")
                               ->type_name("HISTORY");
  command
      .add_option("--difference", arguments.difference,
                  "absolute, or relative to the largest magnitude of the reference [absolute]")
      ->needs(reference)
      ->type_name("absolute|relative");
}

void addRightAxisOptions(CLI::App& command, PlotArguments& arguments) {
  CLI::Option* right = command.get_option("--y2");
  command
      .add_option("--y2-title", arguments.y2Title, "Title of the axis at the right [the formulas in words]")
      ->check(cannotBeShown)
      ->needs(right)
      ->type_name("TEXT");
  command.add_option("--y2-range", arguments.y2Range, "Ends of the axis at the right [round values]")
      ->needs(right)
      ->type_name("LO,HI");
}

}  // namespace

void addPlotCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("plot", "Draw a chart of histories");
  const auto arguments = std::make_shared<PlotArguments>();
  const auto outputs = std::make_shared<ChartOutputs>();
  addDataOptions(*command, *arguments);
  addAxisOptions(*command, arguments->chart, {"the formula in words", "the formulas in words"},
                 {"x", "y", "xy", "y2"});
  addRightAxisOptions(*command, *arguments);
  addDrawingOptions(*command, arguments->chart, "directory, formula or both");
  command->add_option("--csv", outputs->csv, "Write the drawn points to this file too, or print them: -")
      ->type_name("FILE.csv|-");
  command->add_option("-o,--output", outputs->picture, "Name of the chart; - for a PNG on standard output")
      ->type_name("CHART.png|svg|pdf|-");
  command->callback([&action, arguments, outputs] {
    action = [arguments, outputs] { return plot(*arguments, *outputs); };
  });
}

}  // namespace burnish
