#include <fmt/format.h>
#include <json/json.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/chart_options.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "engine/core/error.h"
#include "engine/results/result_files.h"
#include "engine/results/result_reader.h"
#include "postproc/indentation/indentation.h"
#include "postproc/text/json_text.h"
#include "postproc/text/text_file.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

struct IndentationArguments {
  std::vector<std::filesystem::path> results;
  DeclaredOptions evaluation;  ///< of an `IndentationSpec`
  bool json = false;
  ChartArguments chart;
  ChartOutputs outputs;
};

/// Units of a result's numbers; empty where the scene has none.
struct IndentationUnits {
  explicit IndentationUnits(const ModelRecord& model) : length(model.lengthUnit), stress(model.stressUnit) {
    if (!length.empty()) area = length + "²";
    if (!length.empty() && !stress.empty()) {
      force = stress == "MPa" && length == "mm" ? "N" : stress + " " + area;
      stiffness = force == "N" ? "N/mm" : stress + " " + length;
    }
  }
  std::string length, area, force, stiffness, stress;
};

std::string lineOf(const char* name, const char* letter, double value, const std::string& unit,
                   const std::string& more = "") {
  return fmt::format("{:<26} {:<3} {:>14.6g}{}{}\n", name, letter, value, unit.empty() ? "" : " " + unit,
                     more);
}

std::string inPercent(double value, double reference) {
  return fmt::format("{:+.2f} %", 100.0 * (value / reference - 1.0));
}

std::string textOf(const Indentation& run, const IndentationUnits& units) {
  const OliverPharr& found = run.found;
  const auto computed = [&](double value, const std::string& unit) {
    return fmt::format("; with the computed area {:.6g}{}", value, unit.empty() ? "" : " " + unit);
  };
  std::string text =
      lineOf("largest force", "P", found.force, units.force) +
      lineOf("largest depth", "h", found.depth, units.length) +
      lineOf("stiffness at the start", "S", found.stiffness, units.stiffness) +
      lineOf("exponent of the unloading", "m", found.exponent, "",
             fmt::format("; {} steps, misfit {:.2g}", found.numPoints, found.misfit)) +
      lineOf("depth that stays", "hf", found.finalDepth, units.length) +
      lineOf("contact depth", "hc", found.contactDepth, units.length) +
      lineOf("area of the indenter", "A", found.area, units.area,
             run.computed ? fmt::format("; computed {:.6g} ± {:.2g}, {}", run.computed->area,
                                        run.computed->uncertainty, inPercent(run.computed->area, found.area))
                          : "") +
      lineOf("modulus", "E", run.modulus, units.stress,
             run.computed ? computed(run.computed->modulus, units.stress) : "") +
      lineOf("hardness", "H", found.hardness, units.stress,
             run.computed ? computed(run.computed->hardness, units.stress) : "") +
      lineOf("factor of the stiffness", "β", run.beta, "") + lineOf("Poisson's ratio", "ν", run.nu, "");
  if (!run.shortUnloading.empty()) text += fmt::format("doubtful: {}\n", run.shortUnloading);
  if (!run.computed)
    text +=
        fmt::format("no computed area: {}\n", run.noArea.empty() ? "the face ends inside of it" : run.noArea);
  if (run.sceneModulus)
    text += lineOf("modulus of the scene", "E", *run.sceneModulus, units.stress,
                   fmt::format("; found {}{}", inPercent(run.modulus, *run.sceneModulus),
                               run.computed ? ", with the computed area " +
                                                  inPercent(run.computed->modulus, *run.sceneModulus)
                                            : ""));
  return text;
}

Json::Value jsonOf(const Indentation& run, const IndentationUnits& units, const std::string& name) {
  const OliverPharr& found = run.found;
  Json::Value object;
  object["run"] = name;
  object["unit_of_length"] = units.length;
  object["unit_of_stress"] = units.stress;
  for (const auto& [key, value] :
       {std::pair{"force", found.force}, std::pair{"depth", found.depth},
        std::pair{"stiffness", found.stiffness}, std::pair{"exponent", found.exponent},
        std::pair{"final_depth", found.finalDepth}, std::pair{"contact_depth", found.contactDepth},
        std::pair{"area", found.area}, std::pair{"modulus", run.modulus},
        std::pair{"hardness", found.hardness}, std::pair{"beta", run.beta}, std::pair{"nu", run.nu},
        std::pair{"misfit", found.misfit}})
    object[key] = value;
  object["points"] = found.numPoints;
  if (!run.shortUnloading.empty()) object["doubtful"] = run.shortUnloading;
  if (run.sceneModulus) object["modulus_of_scene"] = *run.sceneModulus;
  if (run.computed) {
    object["computed"]["area"] = run.computed->area;
    object["computed"]["uncertainty_of_area"] = run.computed->uncertainty;
    object["computed"]["modulus"] = run.computed->modulus;
    object["computed"]["hardness"] = run.computed->hardness;
  }
  return object;
}

/// Force over depth, and of one run also the fit.
std::vector<ChartCurve> curvesOf(const std::vector<Indentation>& runs,
                                 const std::vector<std::string>& names) {
  constexpr int kPoints = 60;
  std::vector<ChartCurve> curves;
  for (std::size_t k = 0; k < runs.size(); ++k)
    curves.push_back(
        {runs.size() > 1 ? names[k] : "computed", runs[k].curve.depths, runs[k].curve.forces, {}});
  if (runs.size() > 1) return curves;
  const OliverPharr& found = runs.front().found;
  ChartCurve fit{"fit of the unloading", {}, {}, {}}, tangent{"stiffness", {}, {}, {}};
  for (int k = 0; k <= kPoints; ++k) {
    const double depth = std::lerp(found.finalDepth, found.depth, static_cast<double>(k) / kPoints);
    fit.x.push_back(depth);
    fit.y.push_back(found.factor * std::pow(depth - found.finalDepth, found.exponent));
  }
  tangent.x = {found.depth - found.force / found.stiffness, found.depth};
  tangent.y = {0.0, found.force};
  curves.push_back(std::move(fit));
  curves.push_back(std::move(tangent));
  return curves;
}

ExitCode indentation(const IndentationArguments& arguments) {
  constexpr int kDigits = 12;
  const SignalGuard signals(SecondSignal::Ends);
  IndentationSpec spec;
  arguments.evaluation.readInto(spec);
  std::vector<ResultReader> results;
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& result : arguments.results)
    files.push_back(results.emplace_back(result).file());
  requirePrintedAlone(arguments.json, arguments.outputs);
  if (!arguments.outputs.picture.empty() || !arguments.outputs.csv.empty())
    checkOutputs(arguments.outputs, files);
  checkLabels(arguments.chart, results.size(), results.size(), "results");
  const std::vector<std::string> names =
      runNames(arguments.chart, files, modelFile({}).string(), arguments.results);
  std::vector<Indentation> runs;
  for (const ResultReader& result : results) {
    try {
      runs.push_back(indentationOf(result, spec));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", result.file().string(), error.what()));
    }
  }
  const IndentationUnits units(results.front().model());
  for (const ResultReader& result : results)
    if (result.model().lengthUnit != units.length || result.model().stressUnit != units.stress)
      throw Error(fmt::format("{}: found other units than those of {}; expected results alike",
                              result.file().string(), files.front().string()));
  const std::vector<ChartCurve> curves = curvesOf(runs, names);
  if (!arguments.outputs.picture.empty()) {
    Chart chart =
        emptyChart(arguments.chart, withUnit("Depth h", units.length), withUnit("Force P", units.force));
    chart.curves = curves;
    writePicture(chart, arguments.outputs);
  }
  if (arguments.outputs.printsData()) {
    printText(curvesCsv(curves, withUnit("depth", units.length), withUnit("force", units.force)));
    return ExitCode::Fine;
  }
  if (!arguments.outputs.csv.empty())
    writeText(curvesCsv(curves, withUnit("depth", units.length), withUnit("force", units.force)),
              arguments.outputs.csv);
  if (arguments.outputs.printsPicture()) return ExitCode::Fine;
  std::string text;
  Json::Value list(Json::arrayValue);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    list.append(jsonOf(runs[k], units, names[k]));
    if (runs.size() > 1) text += (k > 0 ? "\n" : "") + names[k] + "\n";
    text += textOf(runs[k], units);
  }
  printText(arguments.json ? compactText(list, kDigits) + "\n" : text);
  return ExitCode::Fine;
}

}  // namespace

void addIndentationCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("indentation", "Find modulus and hardness from the unloading of an indentation");
  const auto arguments = std::make_shared<IndentationArguments>();
  command->add_option("RESULT", arguments->results, "Directories of runs or the result files in them")
      ->required();
  arguments->evaluation.addTo(*command, IndentationSpec{});
  command->add_flag("--json", arguments->json, "Print a list of JSON objects");
  addAxisOptions(*command, arguments->chart, {"depth", "force"}, {"x", "y", "xy"});
  addDrawingOptions(*command, arguments->chart, "directory");
  command->add_option("--csv", arguments->outputs.csv, "Write the curves to this file too, or print them: -")
      ->type_name("FILE.csv|-");
  command
      ->add_option("-o,--output", arguments->outputs.picture,
                   "Name of a chart of force over depth; - for a PNG on standard output")
      ->type_name("CHART.png|svg|pdf|-");
  command->callback([&action, arguments] { action = [arguments] { return indentation(*arguments); }; });
}

}  // namespace burnish
