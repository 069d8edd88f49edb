#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/chart_options.h"
#include "cli/console.h"
#include "cli/output_target.h"
#include "engine/core/error.h"
#include "engine/fit/law_fit.h"
#include "postproc/draw/chart/chart.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

struct FitArguments {
  std::vector<std::filesystem::path> files;
  std::string law;
  std::vector<std::string> modes;
  std::optional<int> terms;
  std::string residuals = "relative";
  std::optional<double> youngsModulus;
  double from = 0.002;
  std::filesystem::path output;
  ChartArguments chart;
  ChartOutputs outputs;
};

const FittableLaw& lawOf(const std::string& name) {
  std::vector<std::pair<std::string, const FittableLaw*>> laws;
  for (const FittableLaw& law : fittableLaws()) laws.emplace_back(law.name, &law);
  return *chosen("--law", name, laws);
}

/// Throws `Error` for options that are about other laws.
void checkOptions(const FitArguments& arguments, const FittableLaw& law) {
  const auto refuse = [&](const char* option, const char* reason) {
    throw Error(fmt::format("{}: {} {}; leave it out", option, law.name, reason));
  };
  if (!arguments.modes.empty() && law.data != FitData::RubberTests) refuse("--mode", "is no law of rubber");
  if (arguments.youngsModulus && law.data != FitData::Flow)
    refuse("--nominal", "is not fitted to a tension test of a metal");
  if (arguments.youngsModulus && !(*arguments.youngsModulus > 0.0))
    throw Error(fmt::format("--nominal: found {}; expected a positive number", *arguments.youngsModulus));
  if (arguments.from < 0.0)
    throw Error(fmt::format("--from: found {}; expected a number that is not negative", arguments.from));
  if (!arguments.terms) return;
  if (law.usualTerms == 0) refuse("--terms", "has no number of terms");
  if (*arguments.terms < 1 || *arguments.terms > law.mostTerms)
    throw Error(fmt::format("--terms: found {}; expected 1 to {}", *arguments.terms, law.mostTerms));
}

std::vector<MeasuredCurve> curvesOf(const FitArguments& arguments, const FittableLaw& law) {
  switch (law.data) {
    case FitData::RubberTests:
      return readRubberCurves(arguments.files, arguments.modes);
    case FitData::Flow:
      return readFlowCurves(arguments.files, arguments.youngsModulus, arguments.from);
    default:
      return readCyclicCurves(arguments.files);
  }
}

std::pair<const char*, const char*> axisTitles(FitData data) {
  switch (data) {
    case FitData::RubberTests:
      return {"Stretch", "Nominal stress"};
    case FitData::Flow:
      return {"Plastic strain", "True stress"};
    default:
      return {"Range of the plastic strain", "Amplitude of the stress"};
  }
}

/// The law from where its test begins to the last point of the curve, or from the first one if that is before, or
/// if the start is nothing that a logarithmic axis shows.
ChartCurve lawCurve(const MeasuredCurve& measured, const LawFit& fit, FitData data, const Chart& chart) {
  constexpr int kPieces = 300;
  const double start = data == FitData::RubberTests ? 1.0 : 0.0;
  const auto [first, last] = std::ranges::minmax_element(measured.x);
  const bool isFromFirst = chart.x.logarithmic || chart.y.logarithmic;
  const double from = isFromFirst ? *first : std::min(start, *first);
  const double to = isFromFirst ? *last : std::max(start, *last);
  ChartCurve curve;
  for (int k = 0; k <= kPieces; ++k) {
    const double share = static_cast<double>(k) / kPieces;
    curve.x.push_back(chart.x.logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share);
    curve.y.push_back(fit.value(measured.test, curve.x.back()));
  }
  return curve;
}

Chart chartOf(const FitArguments& arguments, const FittableLaw& law, const std::vector<MeasuredCurve>& curves,
              const LawFit& fit) {
  const auto [xTitle, yTitle] = axisTitles(law.data);
  Chart chart = emptyChart(arguments.chart, xTitle, yTitle);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const int number = static_cast<int>(k);
    chart.curves.push_back({.label = curves[k].name + ", measured",
                            .x = curves[k].x,
                            .y = curves[k].y,
                            .style = CurveStyle{number, 0, number, false}});
    ChartCurve drawn = lawCurve(curves[k], fit, law.data, chart);
    drawn.label = fmt::format("{}, {}", curves[k].name, law.words);
    drawn.style = CurveStyle{number, number, -1};
    chart.curves.push_back(std::move(drawn));
  }
  return chart;
}

/// The constants with the account as comments above them.
std::string documentOf(const FitArguments& arguments, const LawFit& fit) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : arguments.files) names.push_back(file.filename().string());
  std::string text = fmt::format("# Fitted by burnish to {}\n", fmt::join(names, ", "));
  for (const std::string& line : fit.account) text += fmt::format("# {}\n", line);
  for (const std::string& line : fit.warnings) text += fmt::format("# Warning: {}\n", line);
  return text + fit.yaml;
}

ExitCode fitLaw(const FitArguments& arguments) {
  const FittableLaw& law = lawOf(arguments.law);
  checkOptions(arguments, law);
  const FitResiduals residuals = chosen("--residuals", arguments.residuals,
                                        std::array{std::pair{"relative", FitResiduals::Relative},
                                                   std::pair{"absolute", FitResiduals::Absolute}});
  const bool printsLaw = arguments.output.empty() || isStandardOutput(arguments.output);
  if (!arguments.output.empty() && printsLaw && arguments.outputs.printsData())
    throw Error("-o: the law and the points of --csv - would be printed together; expected one of them");
  std::vector<std::filesystem::path> taken = arguments.files;
  if (!printsLaw) requireNotInput("-o", arguments.output, taken);
  taken.push_back(arguments.output);
  requireNotInput("--chart", arguments.outputs.picture, taken);
  taken.push_back(arguments.outputs.picture);
  if (!arguments.outputs.printsData()) requireNotInput("--csv", arguments.outputs.csv, taken);
  std::vector<MeasuredCurve> curves = curvesOf(arguments, law);
  checkLabels(arguments.chart, curves.size(), curves.size(), "measured curves");
  for (std::size_t k = 0; k < arguments.chart.labels.size(); ++k) curves[k].name = arguments.chart.labels[k];
  const LawFit found = law.fit(curves, {arguments.terms.value_or(law.usualTerms), residuals});
  const ChartOutputs& outputs = arguments.outputs;
  if (!outputs.picture.empty() || !outputs.csv.empty()) {
    const Chart chart = chartOf(arguments, law, curves, found);
    if (!outputs.picture.empty()) {
      makeDirectoryOf(outputs.picture);
      drawChart(chart, outputs.picture);
    }
    if (outputs.printsData())
      printText(chartDataText(chart));
    else if (!outputs.csv.empty())
      writeChartData(chart, outputs.csv);
  }
  for (const std::string& warning : found.warnings) printError("warning: {}: {}\n", law.name, warning);
  if (printsLaw) {
    if (!outputs.printsData()) printText(documentOf(arguments, found));
    return ExitCode::Fine;
  }
  writeText(documentOf(arguments, found), arguments.output);
  if (!outputs.printsData())
    for (const std::string& line : found.account) printOut("{}\n", line);
  return ExitCode::Fine;
}

}  // namespace

void addFitCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("fit", "Fit the constants of a material law to measured curves");
  const auto arguments = std::make_shared<FitArguments>();
  command
      ->add_option("DATA", arguments->files, "CSV files of measured points; docs/fit.md says which columns")
      ->required();
  std::vector<std::string> names;
  for (const FittableLaw& law : fittableLaws()) names.emplace_back(law.name);
  command->add_option("--law", arguments->law, fmt::format("{}", fmt::join(names, ", ")))
      ->required()
      ->type_name("LAW");
  command
      ->add_option(
          "--mode", arguments->modes,
          "How rubber was pulled: uniaxial, equibiaxial or planar; once, or once for each file [the column "
          "mode]")
      ->expected(1)
      ->take_all()
      ->type_name("MODE");
  command->add_option("--terms", arguments->terms, "Number of terms of the law [ogden: 3, chaboche: 2]")
      ->type_name("N");
  command
      ->add_option("--residuals", arguments->residuals,
                   "What is made small: relative errors, or absolute ones [relative]")
      ->type_name("KIND");
  command
      ->add_option(
          "--nominal", arguments->youngsModulus,
          "Young's modulus: strain and stress are nominal, of a tension test of a metal, and are converted "
          "[they are plastic strain and true stress]")
      ->type_name("E");
  command
      ->add_option("--from", arguments->from, "Plastic strain from which on converted points count [0.002]")
      ->needs("--nominal")
      ->type_name("EP");
  command
      ->add_option("-o,--output", arguments->output,
                   "File for the constants, to be pasted into a scene [printed]")
      ->type_name("LAW.yaml");
  command->add_option("--chart", arguments->outputs.picture, "Draw the points and the fitted curves")
      ->type_name("CHART.png|svg|pdf");
  command
      ->add_option("--csv", arguments->outputs.csv,
                   "Write what the chart shows to this file too, or print it: -")
      ->type_name("FILE.csv|-");
  command
      ->add_option("--label", arguments->chart.labels,
                   "Name in the legend and the account, once per measured curve [mode, file or both]")
      ->expected(1)
      ->take_all()
      ->check(cannotBeShown)
      ->type_name("TEXT");
  addAxisOptions(*command, arguments->chart, {"what the column holds", "what the column holds"},
                 {"x", "y", "xy"});
  addPageOptions(*command, arguments->chart);
  command->callback([&action, arguments] { action = [arguments] { return fitLaw(*arguments); }; });
}

}  // namespace burnish
