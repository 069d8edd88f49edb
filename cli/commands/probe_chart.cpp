#include "cli/commands/probe_chart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "cli/arguments.h"
#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/quoted.h"
#include "engine/results/result_files.h"
#include "postproc/draw/page/picture_warnings.h"
#include "postproc/probe/probed_run.h"

namespace burnish {
namespace {

ProbeSpec specOf(const ProbeArguments& arguments) {
  AnyProbeSpec spec;
  arguments.probe.readInto(spec);
  const std::vector<InputProblem> problems = conflictsIn(spec);
  if (!problems.empty())
    throw Error(fmt::format("{}: {}", optionName(problems.front().path), problems.front().text));
  return spec;
}

/// Of several frames those that have fields: a series of another program may begin with a bare mesh. Of none with fields all.
std::vector<int> withFields(const ProbeSource& result, const std::vector<int>& frames) {
  if (!result.isBare || frames.size() == 1) return frames;
  std::vector<int> kept, bare;
  for (const int index : frames) (result.isBare(index) ? bare : kept).push_back(index);
  if (kept.empty()) return frames;
  if (!bare.empty())
    noteWarning(fmt::format("{}: there are no fields in frame {}, and so no curve of it",
                            result.file.string(), fmt::join(bare, ", ")));
  return kept;
}

/// A curve per field for each frame, or one over time. name: of the run; empty for the only one.
std::vector<ProbedRun> probedRuns(const ProbeSource& result, const std::string& name, const ProbeSpec& spec,
                                  const std::string& frame) {
  const std::vector<double>& times = result.times;
  const char* usual = spec.isOverTime() ? "all" : "last";
  const std::vector<int> frames = frameIndices(frame.empty() ? usual : frame, times);
  std::vector<ProbedRun> runs;
  if (spec.isOverTime()) {
    runs.push_back(result.overTime(frames, spec));
    runs.back().name = name;
    return runs;
  }
  for (const int index : withFields(result, frames)) {
    throwIfInterrupted();
    runs.push_back(result.inFrame(index, spec));
    runs.back().name = name;
    if (frames.size() > 1)
      runs.back().name +=
          fmt::format("{}t = {:.6g}", name.empty() ? "" : " at ", times[static_cast<std::size_t>(index)]);
  }
  return runs;
}

/// What is wrong with one of several results; behind the option, if it is one that does not suit this result.
Error ofResult(const std::filesystem::path& result, const Error& error) {
  const std::string text = error.what();
  if (text.starts_with(result.string() + ":")) return error;
  const std::size_t end = text.find(": ");
  const bool isOption =
      end != std::string::npos && end > 0 && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_-") == end;
  if (!isOption) return Error(fmt::format("{}: {}", result.string(), text));
  return Error(fmt::format("{}: {}: {}", text.substr(0, end), result.string(), text.substr(end + 2)));
}

/// Calls `act` with each result and its name, which is empty for the only one.
template <class Act>
void forEachResult(const ProbeArguments& arguments, const std::vector<ProbeSource>& results, const Act& act) {
  const bool named = results.size() > 1 || !arguments.chart.labels.empty();
  std::vector<std::filesystem::path> files;
  for (const ProbeSource& result : results) files.push_back(result.file);
  const std::vector<std::string> names =
      runNames(arguments.chart, files, modelFile({}).string(), arguments.results);
  for (std::size_t k = 0; k < results.size(); ++k) {
    try {
      act(results[k], named ? names[k] : "");
    } catch (const Error& error) {
      if (results.size() == 1) throw;
      throw ofResult(arguments.results[k], error);
    }
  }
}

std::vector<ProbedRun> allRuns(const ProbeArguments& arguments, const std::vector<ProbeSource>& results,
                               const ProbeSpec& spec) {
  std::vector<ProbedRun> runs;
  forEachResult(arguments, results, [&](const ProbeSource& result, const std::string& name) {
    for (ProbedRun& run : probedRuns(result, name, spec, arguments.frame)) runs.push_back(std::move(run));
  });
  return runs;
}

/// A row of numbers for each result and frame. make: of a result and the number of a frame.
template <class Row, class Make>
std::string tableOfRows(const ProbeArguments& arguments, const std::vector<ProbeSource>& results,
                        const Make& make) {
  std::vector<Row> rows;
  const ProbeSource& first = results.front();
  forEachResult(arguments, results, [&](const ProbeSource& result, const std::string& name) {
    if (result.stressUnit != first.stressUnit || result.units.length != first.units.length)
      throw Error(fmt::format("--numbers: found other units than those of {}; expected results alike",
                              first.file.string()));
    for (const int index : frameIndices(arguments.frame.empty() ? "last" : arguments.frame, result.times)) {
      throwIfInterrupted();
      rows.push_back({name, result.times[static_cast<std::size_t>(index)], make(result, index)});
    }
  });
  return tableOf(rows, first.units, first.stressUnit);
}

}  // namespace

std::string numbersTable(const ProbeArguments& arguments, const std::vector<ProbeSource>& results) {
  if (arguments.section.empty())
    return tableOfRows<DepthNumbersAt>(arguments, results,
                                       [spec = specOf(arguments)](const ProbeSource& result, int frame) {
                                         return result.depthNumbers(frame, spec);
                                       });
  AnyProbeSpec spec;
  arguments.probe.readInto(spec);
  const std::optional<CutPlane> plane = cutPlaneNamed(arguments.section);
  if (!plane)
    throw Error(fmt::format("--section: found {}; expected {}", quoted(arguments.section), kCutPlaneWords));
  if (!spec.line.empty() || !spec.face.empty() || !spec.depth.empty() || !spec.point.empty())
    throw Error(
        "--section: found beside another place; expected one of --section, --line, --face, --depth and --point");
  for (const auto& [option, isGiven] :
       {std::pair{"--reference", spec.reference}, std::pair{"--field", !spec.fields.empty()},
        std::pair{"--formula", !spec.formula.empty()}, std::pair{"--mean", spec.mean},
        std::pair{"--window", spec.window.has_value()}, std::pair{"--spot", spec.spot.has_value()},
        std::pair{"--penetration", spec.penetration.has_value()},
        std::pair{"--length", spec.length.has_value()}, std::pair{"--patch", !spec.patch.empty()}})
    if (isGiven)
      throw Error(fmt::format(
          "{}: found beside --section, which takes the stress over all of a section; expected none", option));
  return tableOfRows<SectionNumbersAt>(arguments, results, [&](const ProbeSource& result, int frame) {
    return result.sectionNumbers(frame, *plane, spec.bodies);
  });
}

ProbedChart probedChart(const ProbeArguments& arguments, const std::vector<ProbeSource>& results) {
  const ProbeSpec spec = specOf(arguments);
  const std::vector<ProbedRun> runs = allRuns(arguments, results, spec);
  const std::size_t numFields = runs.front().fields.size(), numCurves = runs.size() * numFields;
  const std::vector<std::string>& labels = arguments.chart.labels;
  checkLabels(arguments.chart, results.size(), numCurves, "results");
  const ProbeTitles titles = titlesOf(spec, runs);
  Chart chart = emptyChart(arguments.chart, titles.x, titles.y);
  chart.curves = curvesOf(runs);
  if (labels.size() == numCurves)
    for (std::size_t k = 0; k < numCurves; ++k) chart.curves[k].label = labels[k];
  return {std::move(chart), tableOf(spec, runs)};
}

}  // namespace burnish
