#include "cli/commands/chart_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "cli/arguments.h"
#include "cli/late_vtk.h"
#include "cli/offered_words.h"
#include "cli/output_target.h"
#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "postproc/draw/page/print_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::array kMarkers{std::pair{"some", ChartMarkers::Some}, std::pair{"all", ChartMarkers::All},
                              std::pair{"none", ChartMarkers::None}};

void requireChartName(const fs::path& picture) {
  const std::string ending = picture.extension().string();
  if (picture.empty() || isStandardOutput(picture) || ending == ".png" || isPrintFile(picture)) return;
  throw Error(fmt::format("-o: found {}; expected the name of a chart that ends in .png, .svg or .pdf{}",
                          quoted(picture.string()), ending == ".csv" ? "; --csv names the table" : ""));
}

}  // namespace

bool ChartArguments::isLogarithmic(const char* axis) const {
  return std::ranges::count(logarithmic, axis) > 0;
}

void addAxisOptions(CLI::App& command, ChartArguments& arguments, const UsualTitles& usual,
                    const std::vector<std::string>& logarithmic) {
  const auto add = [&](const char* name, std::string& value, const std::string& help, const char* type) {
    return command.add_option(name, value, help)->type_name(type);
  };
  add("--x-title", arguments.xTitle, fmt::format("Title of the x axis [{}]", usual.x), "TEXT")
      ->check(cannotBeShown);
  add("--y-title", arguments.yTitle, fmt::format("Title of the y axis [{}]", usual.y), "TEXT")
      ->check(cannotBeShown);
  add("--x-range", arguments.xRange, "Ends of the x axis [round values around the data]", "LO,HI");
  add("--y-range", arguments.yRange, "Ends of the y axis [the same]", "LO,HI");
  command
      .add_option("--log", arguments.logarithmic,
                  fmt::format("Logarithmic axes: {}, or several: x,y [none]", fmt::join(logarithmic, ", ")))
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::IsMember(logarithmic))
      ->type_name("AXES");
}

void addPageOptions(CLI::App& command, ChartArguments& arguments) {
  command.add_option("--title", arguments.title, "Title of the chart [none]")
      ->check(cannotBeShown)
      ->type_name("TEXT");
  arguments.look.addTo(command, PageLook{});
  command.add_option("--size", arguments.size, "Size in pixels, or in points for SVG and PDF [1200,900]")
      ->type_name("W,H");
}

void addDrawingOptions(CLI::App& command, ChartArguments& arguments, const char* usualLabel) {
  addPageOptions(command, arguments);
  command
      .add_option("--label", arguments.labels,
                  fmt::format("Name in the legend, once per run or once per curve [{}]", usualLabel))
      ->expected(1)
      ->take_all()
      ->check(cannotBeShown)
      ->type_name("TEXT");
  CLI::Option* markers = command
                             .add_option("--markers", arguments.markers,
                                         "Points with a marker: some (all of a few), all, none [some]")
                             ->type_name("WHICH");
  offerChoices(*markers, kMarkers);
}

std::optional<std::array<double, 2>> axisRange(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  return rangeFromText(option, text);
}

std::string curvesCsv(const std::vector<ChartCurve>& curves, const std::string& xTitle,
                      const std::string& yTitle) {
  std::vector<std::string> titles;
  std::size_t longest = 0;
  for (const ChartCurve& curve : curves) {
    const std::string prefix = curves.size() > 1 ? curve.label + " " : "";
    titles.push_back(prefix + xTitle);
    titles.push_back(prefix + yTitle);
    longest = std::max(longest, curve.x.size());
  }
  std::string text = csvRow(titles) + "\n";
  for (std::size_t k = 0; k < longest; ++k) {
    std::vector<std::string> cells;
    for (const ChartCurve& curve : curves)
      for (const auto* values : {&curve.x, &curve.y})
        cells.push_back(k < values->size() ? fmt::format("{}", (*values)[k]) : "");
    text += csvRow(cells) + "\n";
  }
  return text;
}

Chart emptyChart(const ChartArguments& arguments, const std::string& xTitle, const std::string& yTitle) {
  const bool both = arguments.isLogarithmic("xy");
  Chart chart;
  chart.title = arguments.title;
  chart.x = {arguments.xTitle.empty() ? xTitle : arguments.xTitle, both || arguments.isLogarithmic("x"),
             axisRange("--x-range", arguments.xRange)};
  chart.y = {arguments.yTitle.empty() ? yTitle : arguments.yTitle, both || arguments.isLogarithmic("y"),
             axisRange("--y-range", arguments.yRange)};
  chart.markers = chosen("--markers", arguments.markers, kMarkers);
  PageLook look;
  arguments.look.readInto(look);
  chart.theme = themeOf(look);
  if (!arguments.size.empty()) chart.size = sizeFromText(arguments.size);
  return chart;
}

void checkLabels(const ChartArguments& arguments, std::size_t numRuns, std::size_t numCurves,
                 const char* runs) {
  const std::size_t found = arguments.labels.size();
  if (found == 0 || found == numRuns || found == numCurves) return;
  throw Error(fmt::format("--label: found {} for {} {}; expected one for each{}", found, numRuns, runs,
                          numCurves == numRuns ? "" : fmt::format(" or for each of {} curves", numCurves)));
}

std::vector<std::string> runNames(const ChartArguments& arguments, const std::vector<fs::path>& files,
                                  const std::string& usual, const std::vector<fs::path>& given) {
  if (arguments.labels.size() == files.size()) return arguments.labels;
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(runName(file, usual));
  std::vector<std::string> distinct = names;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::ranges::count(names, names[k]) > 1) distinct[k] = given[k].string();
  return distinct;
}

std::string runName(const fs::path& file, const std::string& usual) {
  if (file.filename() != usual) return file.stem().string();
  std::error_code status;
  const std::string directory = fs::weakly_canonical(file, status).parent_path().filename().string();
  return directory.empty() ? file.stem().string() : directory;
}

void writePicture(const Chart& chart, const ChartOutputs& outputs) {
  loadVtk();
  const OutputTarget target(outputs.picture, ".png");
  makeDirectoryOf(target.file());
  drawChart(chart, target.file());
  target.finish();
}

void requirePrintedAlone(bool json, const ChartOutputs& outputs) {
  if (json && outputs.printsData())
    throw Error("--json: it and the data of --csv - would be printed together; expected one of them");
  if (json && outputs.printsPicture())
    throw Error("--json: it and the picture of -o - would be printed together; expected one of them");
}

void checkOutputs(const ChartOutputs& outputs, std::vector<fs::path> inputs) {
  requireChartName(outputs.picture);
  if (outputs.picture.empty() && outputs.csv.empty())
    throw Error("-o: found no name of a chart; expected one that ends in .png, .svg or .pdf, or --csv FILE");
  if (outputs.printsData() && outputs.printsPicture())
    throw Error("-o: found \"-\" beside --csv -; only one of them can be printed: give the other one a name");
  requireNotInput("-o", outputs.picture, inputs);
  inputs.push_back(outputs.picture);  // not read, but not to be replaced by the data either
  if (!outputs.printsData()) requireNotInput("--csv", outputs.csv, inputs);
}

}  // namespace burnish
