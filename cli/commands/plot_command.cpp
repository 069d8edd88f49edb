#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/plot_chart.h"
#include "cli/console.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

struct PlotOutputs {
  std::filesystem::path picture;
  std::string csv;  ///< a file, or - for standard output
};

std::string differenceText(const LargestDifference& difference, const std::string& x) {
  const CurveDifference& found = difference.found;
  const std::string share = found.referenceMagnitude > 0.0
                                ? fmt::format(" ({:.3g} %)", 100.0 * found.largest / found.referenceMagnitude)
                                : "";
  return fmt::format("{}: largest difference of {}: {:.6g}{} at {} = {:.6g}\n", difference.run, difference.y,
                     found.largest, share, x, found.largestAt);
}

ExitCode plot(const PlotArguments& arguments, const PlotOutputs& outputs) {
  if (outputs.picture.empty() && outputs.csv.empty())
    throw Error("-o: found no name of a chart; expected one that ends in .png, .svg or .pdf, or --csv FILE");
  std::vector<std::filesystem::path> inputs;
  for (const std::filesystem::path& path : arguments.histories) inputs.push_back(historyFile(path));
  if (!arguments.reference.empty()) inputs.push_back(historyFile(arguments.reference));
  requireNotInput("-o", outputs.picture, inputs);
  inputs.push_back(outputs.picture);  // not read, but not to be replaced by the data either
  const bool printed = outputs.csv == "-";
  if (!printed) requireNotInput("--csv", outputs.csv, inputs);
  const PlottedChart plotted = chartOf(arguments);
  if (!outputs.picture.empty()) {
    makeDirectoryOf(outputs.picture);
    drawChart(plotted.chart, outputs.picture);
  }
  if (printed)
    printText(chartDataText(plotted.chart));
  else if (!outputs.csv.empty())
    writeChartData(plotted.chart, outputs.csv);
  for (const LargestDifference& difference : plotted.differences)
    if (printed)
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
      ->type_name("KIND");
}

void addAxisOptions(CLI::App& command, PlotArguments& arguments) {
  CLI::Option* right = command.get_option("--y2");
  const auto add = [&](const char* name, std::string& value, const char* help, const char* type) {
    return command.add_option(name, value, help)->type_name(type);
  };
  add("--x-title", arguments.xTitle, "Title of the x axis [the formula]", "TEXT")->check(cannotBeShown);
  add("--y-title", arguments.yTitle, "Title of the y axis [the formulas]", "TEXT")->check(cannotBeShown);
  add("--y2-title", arguments.y2Title, "Title of the axis at the right [the formulas]", "TEXT")
      ->check(cannotBeShown)
      ->needs(right);
  add("--x-range", arguments.xRange, "Ends of the x axis [round values around the data]", "LO,HI");
  add("--y-range", arguments.yRange, "Ends of the y axis [the same]", "LO,HI");
  add("--y2-range", arguments.y2Range, "Ends of the axis at the right [the same]", "LO,HI")->needs(right);
  command
      .add_option("--log", arguments.logarithmic, "Logarithmic axes: x, y, xy, y2, or several: x,y2 [none]")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::IsMember({"x", "y", "xy", "y2"}))
      ->type_name("AXES");
}

void addDrawingOptions(CLI::App& command, PlotArguments& arguments) {
  command.add_option("--title", arguments.title, "Title of the chart [none]")
      ->check(cannotBeShown)
      ->type_name("TEXT");
  command
      .add_option("--label", arguments.labels,
                  "Name in the legend, once per history or once per curve [directory, formula or both]")
      ->expected(1)
      ->take_all()
      ->check(cannotBeShown)
      ->type_name("TEXT");
  command
      .add_option("--markers", arguments.markers,
                  "Points with a marker: some (all of a few), all, none [some]")
      ->type_name("WHICH");
  arguments.look.addTo(command, PageLook{});
  command.add_option("--size", arguments.size, "Size in pixels, or in points for SVG and PDF [1200,900]")
      ->type_name("W,H");
}

}  // namespace

void addPlotCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("plot", "Draw a chart of histories");
  const auto arguments = std::make_shared<PlotArguments>();
  const auto outputs = std::make_shared<PlotOutputs>();
  addDataOptions(*command, *arguments);
  addAxisOptions(*command, *arguments);
  addDrawingOptions(*command, *arguments);
  command->add_option("--csv", outputs->csv, "Write the drawn points to this file too, or print them: -")
      ->type_name("FILE.csv|-");
  command->add_option("-o,--output", outputs->picture, "Name of the chart")->type_name("CHART.png|svg|pdf");
  command->callback([&action, arguments, outputs] {
    action = [arguments, outputs] { return plot(*arguments, *outputs); };
  });
}

}  // namespace burnish
