#include "cli/commands/probe_chart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/arguments.h"
#include "cli/commands/probe_paths.h"
#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/results/result_files.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/probe/probe.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// What one run has on a path in one frame, or at a point over time.
struct ProbedRun {
  std::string name;  ///< of the run, and of the frame if there are several; empty for the only one
  const ModelRecord& model;
  std::vector<FieldChoice> fields;
  std::vector<ProbePoint> points;
};

std::string withUnit(const std::string& title, const std::string& unit) {
  return unit.empty() ? title : title + " in " + unit;
}

/// The one unit of all; what: "--field", whose are these units.
class CommonUnit {
 public:
  void add(const std::string& what, const std::string& unit) {
    if (!what_.empty() && unit != unit_)
      throw Error(fmt::format("{} has the unit {} and {} the unit {}; expected one unit along an axis", what_,
                              shown(unit_), what, shown(unit)));
    what_ = what;
    unit_ = unit;
  }

  const std::string& text() const { return unit_; }

 private:
  static std::string shown(const std::string& unit) { return unit.empty() ? "1" : unit; }

  std::string what_, unit_;
};

class ProbeReader {
 public:
  ProbeReader(const ProbeArguments& arguments, const std::vector<ResultReader>& results)
      : arguments_(arguments) {
    const bool named = results.size() > 1 || !arguments.chart.labels.empty();
    const std::vector<std::string> names = namesOfRuns(results);
    for (std::size_t k = 0; k < results.size(); ++k) {
      try {
        read(results[k], named ? names[k] : "");
      } catch (const Error& error) {
        if (results.size() == 1) throw;
        throw Error(fmt::format("{}: {}", arguments.results[k].string(), error.what()));
      }
    }
  }

  const std::vector<ProbedRun>& runs() const { return runs_; }

 private:
  std::vector<std::string> namesOfRuns(const std::vector<ResultReader>& results) const {
    std::vector<fs::path> files;
    for (const ResultReader& result : results) files.push_back(result.file());
    return runNames(arguments_.chart, files, modelFile({}).string(), arguments_.results);
  }

  bool isHistory() const { return !arguments_.point.empty(); }

  void read(const ResultReader& result, const std::string& name) {
    const std::vector<double> times = result.times();
    const std::string usual = isHistory() ? "all" : "last";
    const std::vector<int> frames = frameIndices(arguments_.frame.empty() ? usual : arguments_.frame, times);
    if (isHistory()) return readHistoryOf(result, name, frames);
    for (const int index : frames) {
      throwIfInterrupted();
      const ModelFrame shown = shownOf(result, index);
      const ProbedFields fields(shown.model, shown.frame, namesOf(shown.frame));
      const std::string time =
          frames.size() > 1 ? fmt::format("t = {:.6g}", times[static_cast<std::size_t>(index)]) : "";
      runs_.push_back({name + (name.empty() || time.empty() ? "" : " at ") + time, result.model(),
                       fields.choices(),
                       probedPath(shown.model, shown.frame, fields, pathIn(result.model().dim), options())});
    }
  }

  void readHistoryOf(const ResultReader& result, const std::string& name, const std::vector<int>& frames) {
    const ModelFrame first = shownOf(result, frames.front());
    const MaterialPoint point(first.model, pointFromText(arguments_.point, result.model().dim));
    ProbedRun run{name, result.model(), {}, {}};
    for (const int index : frames) {
      throwIfInterrupted();
      const ModelFrame shown = shownOf(result, index);
      const ProbedFields fields(shown.model, shown.frame, namesOf(shown.frame));
      run.fields = fields.choices();
      run.points.push_back(point.in(shown.frame, fields));
    }
    runs_.push_back(std::move(run));
  }

  ModelFrame shownOf(const ResultReader& result, int index) const {
    FrameRecord frame = result.frame(index);
    if (arguments_.bodies.empty()) return {result.model(), std::move(frame)};
    return chosenBodies(result.model(), frame, arguments_.bodies);
  }

  std::vector<std::string> namesOf(const FrameRecord& frame) const {
    return arguments_.fields.empty() ? std::vector{fieldToShow(frame)} : arguments_.fields;
  }

  ProbePath pathIn(int dim) const {
    if (!arguments_.line.empty()) return lineFromText(arguments_.line, dim);
    if (!arguments_.face.empty()) return FacePath{{arguments_.face, arguments_.patch}};
    DepthPath path = depthFromText(arguments_.depth, dim);
    path.address.patch = arguments_.patch;
    path.length = arguments_.length;
    return path;
  }

  ProbeOptions options() const {
    return {arguments_.reference ? ProbedBody::Undeformed : ProbedBody::Deformed, arguments_.points,
            arguments_.window.value_or(0.0)};
  }

  const ProbeArguments& arguments_;
  std::vector<ProbedRun> runs_;
};

std::string distanceWords(const ProbeArguments& arguments) {
  const std::string body = arguments.reference ? "undeformed " : "";
  if (!arguments.face.empty()) return fmt::format("Length along {}face {}", body, arguments.face);
  if (!arguments.depth.empty())
    return fmt::format("Depth below {}face {}", body, arguments.depth.substr(0, arguments.depth.find('@')));
  return arguments.reference ? "Distance in the undeformed body" : "Distance along the line";
}

/// What the fields have in common, as in "Cauchy stress" of two components, else all of them.
std::string fieldWords(const std::vector<FieldChoice>& fields) {
  std::string common = fields.front().words;
  std::vector<std::string> all;
  for (const FieldChoice& field : fields) {
    all.push_back(field.words);
    while (!common.empty() && !(field.words + " ").starts_with(common + " "))
      common.erase(common.find(' ') == std::string::npos ? 0 : common.rfind(' '));
  }
  return common.empty() ? fmt::format("{}", fmt::join(all, ", ")) : common;
}

/// The curve of a field, where other fields and runs have others.
ChartCurve curveOf(const ProbedRun& run, std::size_t field) {
  ChartCurve curve;
  curve.label = run.name;
  if (run.fields.size() > 1) curve.label += (curve.label.empty() ? "" : ": ") + run.fields[field].words;
  for (const ProbePoint& point : run.points) {
    curve.x.push_back(point.at);
    curve.y.push_back(point.values(static_cast<Eigen::Index>(field)));
  }
  return curve;
}

Chart chartOf(const ProbeArguments& arguments, const std::vector<ProbedRun>& runs) {
  const std::size_t numFields = runs.front().fields.size();
  checkLabels(arguments.chart, arguments.results.size(), runs.size() * numFields, "results");
  CommonUnit length, value;
  for (const ProbedRun& run : runs) {
    length.add("the length of " + (run.name.empty() ? "the result" : run.name), run.model.lengthUnit);
    for (const FieldChoice& field : run.fields) value.add(field.name, field.unit);
  }
  std::string yTitle = withUnit(fieldWords(runs.front().fields), value.text());
  if (arguments.window)
    yTitle +=
        fmt::format(", mean over {}{}{}", *arguments.window, length.text().empty() ? "" : " ", length.text());
  Chart chart = emptyChart(
      arguments.chart, arguments.point.empty() ? withUnit(distanceWords(arguments), length.text()) : "Time",
      yTitle);
  for (std::size_t field = 0; field < numFields; ++field)
    for (const ProbedRun& run : runs) {
      chart.curves.push_back(curveOf(run, field));
      if (arguments.chart.labels.size() == runs.size() * numFields)
        chart.curves.back().label = arguments.chart.labels[chart.curves.size() - 1];
    }
  return chart;
}

/// The columns of a run: distance or time, where the material is and was, and the fields.
std::vector<std::string> columnsOf(const ProbeArguments& arguments, const ProbedRun& run) {
  const std::string& unit = run.model.lengthUnit;
  std::vector<std::string> columns{arguments.point.empty() ? labelled("distance", unit) : "time"};
  for (const char* axes : {"xyz", "XYZ"})
    for (int d = 0; d < run.model.dim; ++d) columns.push_back(labelled(std::string(1, axes[d]), unit));
  for (const FieldChoice& field : run.fields) columns.push_back(labelled(field.name, field.unit));
  if (!run.name.empty())
    for (std::string& column : columns) column = run.name + " " + column;
  return columns;
}

std::vector<std::string> cellsOf(const ProbePoint& point) {
  std::vector<std::string> cells{fmt::format("{}", point.at)};
  for (const Eigen::VectorXd* values : {&point.current, &point.reference, &point.values})
    for (const double value : *values) cells.push_back(fmt::format("{}", value));
  return cells;
}

std::string tableOf(const ProbeArguments& arguments, const std::vector<ProbedRun>& runs) {
  std::vector<std::string> titles;
  std::size_t rows = 0;
  for (const ProbedRun& run : runs) {
    const std::vector<std::string> columns = columnsOf(arguments, run);
    titles.insert(titles.end(), columns.begin(), columns.end());
    rows = std::max(rows, run.points.size());
  }
  std::string text = csvRow(titles) + "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const ProbedRun& run : runs) {
      const std::vector<std::string> own = row < run.points.size()
                                               ? cellsOf(run.points[row])
                                               : std::vector<std::string>(columnsOf(arguments, run).size());
      cells.insert(cells.end(), own.begin(), own.end());
    }
    text += csvRow(cells) + "\n";
  }
  return text;
}

void requirePositive(const char* option, const std::optional<double>& length) {
  if (length && !(*length > 0.0 && std::isfinite(*length)))
    throw Error(fmt::format("{}: found {}; expected a positive length", option, *length));
}

void check(const ProbeArguments& arguments) {
  if (arguments.line.empty() && arguments.point.empty() && arguments.face.empty() && arguments.depth.empty())
    throw Error("found no place; expected one of --line, --point, --face and --depth");
  if (!arguments.patch.empty() && arguments.face.empty() && arguments.depth.empty())
    throw Error("--patch: names the patch of a face; expected --face or --depth beside it");
  requirePositive("--window", arguments.window);
  requirePositive("--length", arguments.length);
}

}  // namespace

ProbedChart probedChart(const ProbeArguments& arguments, const std::vector<ResultReader>& results) {
  check(arguments);
  const ProbeReader reader(arguments, results);
  return {chartOf(arguments, reader.runs()), tableOf(arguments, reader.runs())};
}

}  // namespace burnish
