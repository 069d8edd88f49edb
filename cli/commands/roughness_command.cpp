#include <fmt/format.h>

#include <json/json.h>

#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "engine/core/interruption.h"
#include "engine/results/result_files.h"
#include "engine/results/result_reader.h"
#include "postproc/surface/face_roughness.h"
#include "postproc/text/json_text.h"
#include "postproc/text/text_file.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

struct RoughnessArguments {
  std::vector<std::filesystem::path> results;
  DeclaredOptions face;  ///< of a `RoughnessSpec`
  std::string frame = "last";
  bool json = false;
  ChartArguments chart;
  ChartOutputs outputs;
};

/// One line of the table, and the curve of a plane face.
struct RoughnessRow {
  std::string run;
  double time = 0.0, a = 0.0, q = 0.0, z = 0.0, extent = 0.0;
  int samplingLengths = 1;
  Profile profile{};
};

std::vector<RoughnessRow> rowsOf(const ResultReader& result, const std::string& frames,
                                 const RoughnessSpec& spec, const std::string& run) {
  const std::vector<double> times = result.times();
  std::vector<RoughnessRow> rows;
  for (const int index : frameIndices(frames, times)) {
    throwIfInterrupted();
    const FrameRecord frame = result.frame(index);
    RoughnessRow row{run, times[static_cast<std::size_t>(index)]};
    if (result.model().dim == 2) {
      FaceProfile face = faceProfile(result.model(), frame, spec);
      row.a = face.roughness.a;
      row.q = face.roughness.q;
      row.z = face.roughness.z;
      row.extent = face.roughness.length;
      row.samplingLengths = face.roughness.samplingLengths;
      row.profile = std::move(face.profile);
    } else {
      const AreaRoughness area = faceArea(result.model(), frame, spec);
      row.a = area.a;
      row.q = area.q;
      row.z = area.z;
      row.extent = area.area;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// "R" of profiles, "S" of areas.
std::string letterOf(int dim) {
  return dim == 2 ? "R" : "S";
}

std::string tableOf(const std::vector<RoughnessRow>& rows, int dim, const std::string& unit) {
  const std::string letter = letterOf(dim);
  std::string text;
  const bool named = !rows.front().run.empty();
  const auto column = [&](const char* name) { return withUnit(letter + name, unit); };
  text += fmt::format("{}{:>12} {:>14} {:>14} {:>14}\n", named ? fmt::format("{:<20} ", "run") : "", "time",
                      column("a"), column("q"), column("z"));
  for (const RoughnessRow& row : rows)
    text += fmt::format("{}{:>12.6g} {:>14.6g} {:>14.6g} {:>14.6g}\n",
                        named ? fmt::format("{:<20} ", row.run) : "", row.time, row.a, row.q, row.z);
  return text;
}

std::string jsonOf(const std::vector<RoughnessRow>& rows, int dim, const std::string& unit) {
  constexpr int kDigits = 12;
  const std::string letter = letterOf(dim);
  Json::Value list(Json::arrayValue);
  for (const RoughnessRow& row : rows) {
    Json::Value object;
    object["run"] = row.run;
    object["time"] = row.time;
    object["unit"] = unit;
    object[letter + "a"] = row.a;
    object[letter + "q"] = row.q;
    object[letter + "z"] = row.z;
    object[dim == 2 ? "length" : "area"] = row.extent;
    if (dim == 2) object["sampling_lengths"] = row.samplingLengths;
    list.append(std::move(object));
  }
  return compactText(list, kDigits) + "\n";
}

std::vector<ChartCurve> curvesOf(const std::vector<RoughnessRow>& rows, bool severalTimes) {
  std::vector<ChartCurve> curves;
  for (const RoughnessRow& row : rows) {
    ChartCurve curve;
    curve.label = row.run;
    if (severalTimes) curve.label += fmt::format("{}t = {:.6g}", row.run.empty() ? "" : " at ", row.time);
    for (Eigen::Index k = 0; k < row.profile.heights.size(); ++k) {
      curve.x.push_back(row.profile.begin + static_cast<double>(k) * row.profile.spacing);
      curve.y.push_back(row.profile.heights(k));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

ExitCode roughness(const RoughnessArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  RoughnessSpec spec;
  arguments.face.readInto(spec);
  if (spec.face.empty()) throw Error("--face: found no face; expected one, such as top");
  std::vector<ResultReader> results;
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& result : arguments.results)
    files.push_back(results.emplace_back(result).file());
  const int dim = results.front().model().dim;
  const std::string unit = results.front().model().lengthUnit;
  for (const ResultReader& result : results)
    if (result.model().dim != dim || result.model().lengthUnit != unit)
      throw Error(fmt::format(
          "{}: found other dimensions or units of length than those of {}; expected results alike",
          result.file().string(), files.front().string()));
  if (arguments.json && arguments.outputs.printsData())
    throw Error("--json: it and the profiles of --csv - would be printed together; expected one of them");
  const bool draws = !arguments.outputs.picture.empty() || !arguments.outputs.csv.empty();
  if (draws && dim == 3)
    throw Error(fmt::format("{}: an area has no profile; expected the numbers alone, or a plane body",
                            arguments.outputs.picture.empty() ? "--csv" : "-o"));
  if (draws) checkOutputs(arguments.outputs, files);
  const bool named = results.size() > 1 || !arguments.chart.labels.empty();
  const std::vector<std::string> names =
      runNames(arguments.chart, files, modelFile({}).string(), arguments.results);
  checkLabels(arguments.chart, results.size(), results.size(), "results");
  std::vector<RoughnessRow> rows;
  for (std::size_t k = 0; k < results.size(); ++k)
    for (RoughnessRow& row : rowsOf(results[k], arguments.frame, spec, named ? names[k] : ""))
      rows.push_back(std::move(row));
  const std::vector<ChartCurve> curves = curvesOf(rows, rows.size() > results.size());
  if (!arguments.outputs.picture.empty()) {
    Chart chart =
        emptyChart(arguments.chart, withUnit("Distance along face " + spec.face, unit),
                   withUnit(spec.cutoff ? "Height of roughness" : "Height about the mean line", unit));
    chart.curves = curves;
    makeDirectoryOf(arguments.outputs.picture);
    drawChart(chart, arguments.outputs.picture);
  }
  if (!arguments.outputs.csv.empty() && !arguments.outputs.printsData())
    writeText(curvesCsv(curves, withUnit("distance", unit), withUnit("height", unit)), arguments.outputs.csv);
  if (arguments.outputs.printsData())
    printText(curvesCsv(curves, withUnit("distance", unit), withUnit("height", unit)));
  else
    printText(arguments.json ? jsonOf(rows, dim, unit) : tableOf(rows, dim, unit));
  return ExitCode::Fine;
}

}  // namespace

void addRoughnessCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("roughness", "Tell how rough a face is: Ra, Rq, Rz, or Sa, Sq, Sz");
  const auto arguments = std::make_shared<RoughnessArguments>();
  command->add_option("RESULT", arguments->results, "Directories of runs or the result files in them")
      ->required();
  command
      ->add_option("--frame", arguments->frame,
                   "Number of the frame, last or end, or time=T; for several A-B or all")
      ->type_name("N|A-B|all|last|time=T")
      ->capture_default_str();
  arguments->face.addTo(*command, RoughnessSpec{});
  command->add_flag("--json", arguments->json, "Print a list of JSON objects");
  addAxisOptions(*command, arguments->chart, {"distance", "height"}, {"x", "y", "xy"});
  addDrawingOptions(*command, arguments->chart, "directory, time or both");
  command
      ->add_option("--csv", arguments->outputs.csv, "Write the profiles to this file too, or print them: -")
      ->type_name("FILE.csv|-");
  command->add_option("-o,--output", arguments->outputs.picture, "Name of a chart of the profiles")
      ->type_name("CHART.png|svg|pdf");
  command->callback([&action, arguments] { action = [arguments] { return roughness(*arguments); }; });
}

}  // namespace burnish
