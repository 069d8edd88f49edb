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

/// A point is looked at over time, and so is the mean of a path.
bool isOverTime(const ProbeArguments& arguments) {
  return arguments.mean || !arguments.point.empty();
}

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

  void read(const ResultReader& result, const std::string& name) {
    const std::vector<double> times = result.times();
    const bool isHistory = isOverTime(arguments_);
    const std::string usual = isHistory ? "all" : "last";
    const std::vector<int> frames = frameIndices(arguments_.frame.empty() ? usual : arguments_.frame, times);
    if (isHistory) return readHistoryOf(result, name, frames);
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
    const int dim = result.model().dim;
    const ModelFrame first = shownOf(result, frames.front());
    std::optional<MaterialPoint> point;
    if (!arguments_.point.empty()) point.emplace(first.model, pointFromText(arguments_.point, dim));
    ProbedRun run{name, result.model(), {}, {}};
    for (const int index : frames) {
      throwIfInterrupted();
      const ModelFrame shown = shownOf(result, index);
      const ProbedFields fields(shown.model, shown.frame, namesOf(shown.frame));
      run.fields = fields.choices();
      run.points.push_back(point ? point->in(shown.frame, fields)
                                 : probedMean(shown.model, shown.frame, fields, pathIn(dim), options()));
    }
    if (std::ranges::all_of(run.points, [](const ProbePoint& p) { return p.values.array().isNaN().all(); }))
      throw Error("no point of the path is in a body with the field in any of the frames");
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

/// "the line", "face top", ...
std::string pathWords(const ProbeArguments& arguments) {
  const std::string& face = arguments.face.empty() ? arguments.depth : arguments.face;
  const std::string name = face.empty() ? "the line" : "face " + face.substr(0, face.find('@'));
  return arguments.reference ? name + " of the undeformed body" : name;
}

std::string distanceWords(const ProbeArguments& arguments) {
  const char* what = !arguments.line.empty()   ? "Distance along"
                     : !arguments.face.empty() ? "Length along"
                                               : "Depth below";
  return fmt::format("{} {}", what, pathWords(arguments));
}

/// What the values are means of; empty for values at points.
std::string meanWords(const ProbeArguments& arguments, const std::string& lengthUnit) {
  if (arguments.window)
    return fmt::format(", mean over {}{}{}", *arguments.window, lengthUnit.empty() ? "" : " ", lengthUnit);
  if (!arguments.mean) return "";
  return fmt::format(", mean {} {}", arguments.depth.empty() ? "along" : "below", pathWords(arguments));
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
  Chart chart = emptyChart(
      arguments.chart, isOverTime(arguments) ? "Time" : withUnit(distanceWords(arguments), length.text()),
      withUnit(fieldWords(runs.front().fields), value.text()) + meanWords(arguments, length.text()));
  for (std::size_t field = 0; field < numFields; ++field)
    for (const ProbedRun& run : runs) {
      chart.curves.push_back(curveOf(run, field));
      if (arguments.chart.labels.size() == runs.size() * numFields)
        chart.curves.back().label = arguments.chart.labels[chart.curves.size() - 1];
    }
  return chart;
}

/// The columns of a run: distance or time, of points where the material is and was, and the fields.
std::vector<std::string> columnsOf(const ProbeArguments& arguments, const ProbedRun& run) {
  const std::string& unit = run.model.lengthUnit;
  std::vector<std::string> columns{isOverTime(arguments) ? "time" : labelled("distance", unit)};
  for (const char* axes : {"xyz", "XYZ"})
    for (int d = 0; !arguments.mean && d < run.model.dim; ++d)
      columns.push_back(labelled(std::string(1, axes[d]), unit));
  for (const FieldChoice& field : run.fields) columns.push_back(labelled(field.name, field.unit));
  if (!run.name.empty())
    for (std::string& column : columns) column = run.name + " " + column;
  return columns;
}

std::vector<std::string> cellsOf(const ProbeArguments& arguments, const ProbePoint& point) {
  std::vector<std::string> cells{fmt::format("{}", point.at)};
  const auto add = [&](const Eigen::VectorXd& values) {
    for (const double value : values) cells.push_back(fmt::format("{}", value));
  };
  if (!arguments.mean) {
    add(point.current);
    add(point.reference);
  }
  add(point.values);
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
                                               ? cellsOf(arguments, run.points[row])
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
