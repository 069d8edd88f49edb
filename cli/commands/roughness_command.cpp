#include <fmt/format.h>

#include <json/json.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/chart_options.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "cli/late_vtk.h"
#include "cli/output_target.h"
#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/unit_label.h"
#include "engine/results/history.h"
#include "engine/results/result_files.h"
#include "engine/results/result_reader.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/draw/page/print_file.h"
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

/// One line of the table, and the curve of a profile.
struct RoughnessRow {
  std::string run;
  double time = 0.0, a = 0.0, q = 0.0, z = 0.0, extent = 0.0;
  int samplingLengths = 1;
  Profile profile{};
  FaceArea area{};  ///< else
  int frame = 0;
};

/// What the command looks at: a run, or a profile that was measured.
struct RoughnessSource {
  std::filesystem::path file;
  std::optional<ResultReader> result;  ///< of a run
  Eigen::Matrix2Xd measured;           ///< else places and heights
  std::string unit;                    ///< of lengths

  bool isArea(const RoughnessSpec& spec) const { return result && !hasProfile(result->model(), spec); }
};

bool isTable(const std::filesystem::path& file) {
  std::error_code status;
  return file.extension() == ".csv" && !std::filesystem::is_directory(file, status);
}

/// The name of a column without its unit in brackets, and the unit.
std::pair<std::string, std::string> nameAndUnit(const std::string& column) {
  const std::size_t open = column.find(" [");
  if (open == std::string::npos || !column.ends_with(']')) return {column, ""};
  return {column.substr(0, open), column.substr(open + 2, column.size() - open - 3)};
}

/// What lengths of one unit are multiplied by to be of another one; nothing for a unit that is not known.
std::optional<double> lengthFactor(const std::string& from, const std::string& to) {
  if (from == to) return 1.0;
  const auto known = lengthUnitOf(from), wanted = lengthUnitOf(to);
  if (!known || !wanted) return std::nullopt;
  return millimetresOf(*known) / millimetresOf(*wanted);
}

/// Throws `Error` that names the file for one that is no table of places, which increase, and heights.
Eigen::Matrix2Xd measuredProfile(const HistoryTable& table) {
  const std::string file = table.path.string();
  if (table.columns.size() != 2)
    throw Error(
        fmt::format("{}: found {} columns; expected two, places along the profile and heights, each with "
                    "its unit in brackets, such as x [mm]",
                    file, table.columns.size()));
  if (table.numRows() < 2)
    throw Error(fmt::format("{}: found {} rows; expected two or more", file, table.numRows()));
  Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(table.numRows()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const auto row = static_cast<std::size_t>(k);
    points.col(k) << table.values[0][row], table.values[1][row];
    if (!points.col(k).allFinite())
      throw Error(fmt::format("{}: row {} is not finite; expected numbers", file, k + 1));
    if (k > 0 && !(points(0, k) > points(0, k - 1)))
      throw Error(fmt::format("{}: found the place {} in row {} behind {}; expected places that increase",
                              file, points(0, k), k + 1, points(0, k - 1)));
  }
  return points;
}

/// Heights at equal distances, those of the file among them where it has equal distances. Throws `Error` as
/// `roughnessOf`.
RoughnessRow rowOf(const Eigen::Matrix2Xd& measured, const RoughnessSpec& spec, const std::string& run) {
  constexpr int kPerPoint = 4;
  const Profile profile = profileOf(measured, kPerPoint * (static_cast<int>(measured.cols()) - 1) + 1);
  const ProfileRoughness found = roughnessOf(profile, spec.cutoff);
  RoughnessRow row{run,
                   std::numeric_limits<double>::quiet_NaN(),
                   found.a,
                   found.q,
                   found.z,
                   found.length,
                   found.samplingLengths};
  row.profile = spec.cutoff ? roughnessProfile(levelled(profile), *spec.cutoff) : levelled(profile);
  return row;
}

std::vector<RoughnessRow> rowsOf(const ResultReader& result, const std::string& frames,
                                 const RoughnessSpec& spec, const std::string& run) {
  const std::vector<double> times = result.times();
  std::vector<RoughnessRow> rows;
  for (const int index : frameIndices(frames, times)) {
    throwIfInterrupted();
    const FrameRecord frame = result.frame(index);
    RoughnessRow row{run, times[static_cast<std::size_t>(index)]};
    row.frame = index;
    if (hasProfile(result.model(), spec)) {
      FaceProfile face = faceProfile(result.model(), frame, spec);
      row.a = face.roughness.a;
      row.q = face.roughness.q;
      row.z = face.roughness.z;
      row.extent = face.roughness.length;
      row.samplingLengths = face.roughness.samplingLengths;
      row.profile = std::move(face.profile);
    } else {
      row.area = faceArea(result.model(), frame, spec);
      const AreaRoughness& area = row.area.roughness;
      row.a = area.a;
      row.q = area.q;
      row.z = area.z;
      row.extent = area.area;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Throws `Error` for what cannot be read, and for options that do not fit it.
RoughnessSource sourceOf(const std::filesystem::path& path, const RoughnessSpec& spec) {
  if (isTable(path)) {
    if (!spec.within.empty())
      throw Error(
          fmt::format("--within: {} was measured and has no undeformed body; expected runs", path.string()));
    const HistoryTable table = readHistory(path);
    RoughnessSource source{path, {}, measuredProfile(table), nameAndUnit(table.columns[0]).second};
    const auto factor = lengthFactor(nameAndUnit(table.columns[1]).second, source.unit);
    if (!factor)
      throw Error(fmt::format("{}: found the columns {} and {}; expected one unit of both, or two of {}",
                              path.string(), table.columns[0], table.columns[1], kLengthLabels));
    source.measured.row(1) *= *factor;
    return source;
  }
  if (spec.face.empty()) throw Error("--face: found no face; expected one, such as top");
  ResultReader result(path);
  const std::string unit = result.model().lengthUnit;
  const std::filesystem::path file = result.file();
  return {file, std::move(result), {}, unit};
}

/// Brings measured profiles to the unit of the runs, or of the first profile. Throws `Error` for lengths that cannot be.
void unifyUnits(std::vector<RoughnessSource>& sources) {
  const auto isRun = [](const RoughnessSource& source) { return source.result.has_value(); };
  const auto run = std::ranges::find_if(sources, isRun);
  const RoughnessSource& leading = run == sources.end() ? sources.front() : *run;
  const auto words = [](const std::string& unit) { return unit.empty() ? "without a unit" : "in " + unit; };
  for (RoughnessSource& source : sources) {
    const auto factor =
        isRun(source) && source.unit != leading.unit ? std::nullopt : lengthFactor(source.unit, leading.unit);
    if (!factor)
      throw Error(fmt::format(
          "{}: found lengths {}, and those of {} {}; expected one unit of all, or of a profile one of {}",
          source.file.string(), words(source.unit), leading.file.string(), words(leading.unit),
          kLengthLabels));
    if (!isRun(source)) source.measured *= *factor;
    source.unit = leading.unit;
    if (run != sources.end() && !isRun(source) && leading.unit.empty())
      noteWarning(fmt::format(
          "{}: neither its lengths nor those of {} have a unit; they are taken for the same. Name them: x [mm] "
          "in the table, units: {{length: mm}} in the scene",
          source.file.string(), leading.file.string()));
  }
}

std::vector<RoughnessRow> rowsOf(const RoughnessSource& source, const std::string& frames,
                                 const RoughnessSpec& spec, const std::string& run) {
  if (source.result) return rowsOf(*source.result, frames, spec, run);
  try {
    return {rowOf(source.measured, spec, run)};
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", source.file.string(), error.what()));
  }
}

/// "R" of profiles, "S" of areas.
std::string letterOf(bool isArea) {
  return isArea ? "S" : "R";
}

/// named: with the names of the runs.
std::string tableOf(const std::vector<RoughnessRow>& rows, bool isArea, const std::string& unit, bool named) {
  const std::string letter = letterOf(isArea);
  std::string text;
  const auto column = [&](const char* name) { return withUnit(letter + name, unit); };
  text += fmt::format("{}{:>12} {:>14} {:>14} {:>14}\n", named ? fmt::format("{:<20} ", "run") : "", "time",
                      column("a"), column("q"), column("z"));
  for (const RoughnessRow& row : rows)
    text +=
        fmt::format("{}{:>12} {:>14.6g} {:>14.6g} {:>14.6g}\n", named ? fmt::format("{:<20} ", row.run) : "",
                    std::isnan(row.time) ? "measured" : fmt::format("{:.6g}", row.time), row.a, row.q, row.z);
  return text;
}

std::string jsonOf(const std::vector<RoughnessRow>& rows, bool isArea, const std::string& unit) {
  constexpr int kDigits = 12;
  const std::string letter = letterOf(isArea);
  Json::Value list(Json::arrayValue);
  for (const RoughnessRow& row : rows) {
    Json::Value object;
    object["run"] = row.run;
    object["time"] = std::isnan(row.time) ? Json::Value() : Json::Value(row.time);
    object["unit"] = unit;
    object[letter + "a"] = row.a;
    object[letter + "q"] = row.q;
    object[letter + "z"] = row.z;
    object[isArea ? "area" : "length"] = row.extent;
    if (!isArea) object["sampling_lengths"] = row.samplingLengths;
    list.append(std::move(object));
  }
  return compactText(list, kDigits) + "\n";
}

std::vector<ChartCurve> curvesOf(const std::vector<RoughnessRow>& rows, bool named, bool severalTimes) {
  std::vector<ChartCurve> curves;
  for (const RoughnessRow& row : rows) {
    ChartCurve curve;
    if (named) curve.label = row.run;
    if (severalTimes && !std::isnan(row.time))
      curve.label += fmt::format("{}t = {:.6g}", curve.label.empty() ? "" : " at ", row.time);
    for (Eigen::Index k = 0; k < row.profile.heights.size(); ++k) {
      curve.x.push_back(row.profile.begin + static_cast<double>(k) * row.profile.spacing);
      curve.y.push_back(row.profile.heights(k));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Where the points of faces in space are, and their heights about the mean plane, as CSV.
std::string mapOf(const std::vector<RoughnessRow>& rows, const std::string& unit, bool named) {
  std::vector<std::string> titles{"time"};
  for (const char* column : {"x", "y", "z", "height"}) titles.push_back(withUnit(column, unit));
  if (named) titles.insert(titles.begin(), "run");
  std::string text = csvRow(titles) + "\n";
  for (const RoughnessRow& row : rows)
    for (Eigen::Index k = 0; k < row.area.places.cols(); ++k) {
      std::vector<std::string> cells{fmt::format("{}", row.time)};
      for (int d = 0; d < 3; ++d) cells.push_back(fmt::format("{}", row.area.places(d, k)));
      cells.push_back(fmt::format("{}", row.area.roughness.heights(k)));
      if (named) cells.insert(cells.begin(), row.run);
      text += csvRow(cells) + "\n";
    }
  return text;
}

/// Heights as colours over the area as seen from outside. Throws `Error` as `heightMap`, and for options of curves.
void drawMap(const RoughnessArguments& arguments, const ResultReader& result, const RoughnessRow& row) {
  const ChartArguments& asked = arguments.chart;
  for (const auto& [option, isGiven] :
       {std::pair{"--x-range", !asked.xRange.empty()}, std::pair{"--x-title", !asked.xTitle.empty()},
        std::pair{"--y-title", !asked.yTitle.empty()}, std::pair{"--log", !asked.logarithmic.empty()},
        std::pair{"--label", !asked.labels.empty()}})
    if (isGiven)
      throw Error(fmt::format(
          "{}: found beside the map of an area, which has no curves; expected a profile, of --line", option));
  const ModelFrame map = heightMap(result.model(), result.frame(row.frame), row.area);
  ContourOptions options;
  asked.look.readInto(static_cast<PageLook&>(options));
  if (isPrintFile(arguments.outputs.picture)) options.size = kPrintSize;
  if (!asked.size.empty()) options.size = sizeFromText(asked.size);
  if (!asked.title.empty()) options.title = asked.title;
  options.field = kHeightField;
  options.range = axisRange("--y-range", asked.yRange);
  options.undeformed = false;
  options.lengthAxes = true;
  if (options.doubtMarks) options.doubt = doubtMarkOf(result.file().parent_path());
  loadVtk();
  const OutputTarget target(arguments.outputs.picture, ".png");
  makeDirectoryOf(target.file());
  drawContour(map.model, map.frame, options, target.file());
  target.finish();
}

ExitCode roughness(const RoughnessArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  RoughnessSpec spec;
  arguments.face.readInto(spec);
  std::vector<RoughnessSource> sources;
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : arguments.results)
    files.push_back(sources.emplace_back(sourceOf(path, spec)).file);
  unifyUnits(sources);
  const bool isArea = sources.front().isArea(spec);
  const std::string unit = sources.front().unit;
  for (const RoughnessSource& source : sources) {
    if (source.isArea(spec) != isArea)
      throw Error(fmt::format(
          "{}: found an area beside profiles; expected one of the two, or --line over the face in space",
          (isArea ? sources.front() : source).file.string()));
  }
  if (!spec.line.empty() &&
      std::ranges::none_of(sources, [](const RoughnessSource& one) { return one.result.has_value(); }))
    throw Error("--line: found measured profiles alone; expected a run in space beside them");
  requirePrintedAlone(arguments.json, arguments.outputs);
  const bool draws = !arguments.outputs.picture.empty() || !arguments.outputs.csv.empty();
  if (draws) checkOutputs(arguments.outputs, files);
  const bool named = sources.size() > 1 || !arguments.chart.labels.empty();
  const std::vector<std::string> names =
      runNames(arguments.chart, files, modelFile({}).string(), arguments.results);
  checkLabels(arguments.chart, sources.size(), sources.size(), "results");
  std::vector<RoughnessRow> rows;
  for (std::size_t k = 0; k < sources.size(); ++k)
    for (RoughnessRow& row : rowsOf(sources[k], arguments.frame, spec, names[k]))
      rows.push_back(std::move(row));
  const std::vector<ChartCurve> curves = curvesOf(rows, named, rows.size() > sources.size());
  if (!arguments.outputs.picture.empty() && isArea) {
    if (rows.size() > 1)
      throw Error(fmt::format("-o: found {} areas; expected one result and frame for a map", rows.size()));
    drawMap(arguments, *sources.front().result, rows.front());
  } else if (!arguments.outputs.picture.empty()) {
    Chart chart = emptyChart(
        arguments.chart, withUnit(spec.face.empty() ? "Distance" : "Distance along face " + spec.face, unit),
        withUnit(spec.cutoff ? "Height of roughness" : "Height about the mean line", unit));
    chart.curves = curves;
    writePicture(chart, arguments.outputs);
  }
  const auto data = [&] {
    return isArea ? mapOf(rows, unit, named)
                  : curvesCsv(curves, withUnit("distance", unit), withUnit("height", unit));
  };
  if (!arguments.outputs.csv.empty() && !arguments.outputs.printsData())
    writeText(data(), arguments.outputs.csv);
  if (arguments.outputs.printsData())
    printText(data());
  else if (!arguments.outputs.printsPicture())
    printText(arguments.json ? jsonOf(rows, isArea, unit) : tableOf(rows, isArea, unit, named));
  return ExitCode::Fine;
}

}  // namespace

void addRoughnessCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("roughness", "Tell how rough a face is: Ra, Rq, Rz, or Sa, Sq, Sz");
  const auto arguments = std::make_shared<RoughnessArguments>();
  command
      ->add_option(
          "RESULT", arguments->results,
          "Directories of runs, the result files in them, or measured profiles: CSV, places and heights")
      ->required();
  command
      ->add_option("--frame", arguments->frame,
                   "Number of the frame, last or end, or time=T; for several A-B, all, or a list with commas")
      ->type_name("N|A-B|all|last|time=T")
      ->capture_default_str();
  arguments->face.addTo(*command, RoughnessSpec{});
  command->add_flag("--json", arguments->json, "Print a list of JSON objects");
  addAxisOptions(*command, arguments->chart, {"distance", "height"}, {"x", "y", "xy"});
  addDrawingOptions(*command, arguments->chart, "directory, time or both");
  command
      ->add_option("--csv", arguments->outputs.csv,
                   "Write the profiles, or heights of areas, to this file too, or print them: -")
      ->type_name("FILE.csv|-");
  command
      ->add_option("-o,--output", arguments->outputs.picture,
                   "Name of a chart of the profiles, or of a map of an area; - for a PNG on standard output")
      ->type_name("PICTURE.png|svg|pdf|-");
  command->callback([&action, arguments] { action = [arguments] { return roughness(*arguments); }; });
}

}  // namespace burnish
