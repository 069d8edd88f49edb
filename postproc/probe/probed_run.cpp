#include "postproc/probe/probed_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include "engine/core/csv.h"
#include "engine/core/error.h"
#include "engine/core/formula.h"
#include "engine/core/interruption.h"
#include "engine/core/same_time.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/mesh/vtk_arrays.h"
#include "postproc/probe/contact_probe.h"
#include "postproc/probe/path_text.h"
#include "postproc/probe/probe.h"
#include "postproc/text/units.h"

namespace burnish {
namespace {

/// The one unit of all that stand along an axis.
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

/// Calls `act` with the model and the frame of the bodies that are looked at.
template <class Act>
auto withChosenBodies(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec,
                      const Act& act) {
  PictureOptions shown;
  shown.bodies = spec.bodies;
  return withShownModel(model, frame, shown, act);
}

ProbedFields fieldsOf(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  return {model, frame, spec.fields.empty() ? std::vector{fieldToShow(frame)} : spec.fields};
}

ProbeOptions optionsOf(const ProbeSpec& spec) {
  return {spec.reference ? ProbedBody::Undeformed : ProbedBody::Deformed, spec.points,
          spec.window.value_or(0.0), spec.spot.value_or(0.0), spec.penetration.value_or(0.0)};
}

/// "the line", "face top", "the line on face top", ...
std::string pathWords(const ProbeSpec& spec) {
  const std::string& face = spec.face.empty() ? spec.depth : spec.face;
  std::string name = spec.line.empty() ? "" : "the line";
  if (!face.empty()) name += (name.empty() ? "face " : " on face ") + face.substr(0, face.find('@'));
  return spec.reference ? name + " of the undeformed body" : name;
}

std::string distanceWords(const ProbeSpec& spec) {
  const char* what = !spec.line.empty()   ? "Distance along"
                     : !spec.face.empty() ? "Length along"
                                          : "Depth below";
  return fmt::format("{} {}", what, pathWords(spec));
}

/// What the values are means of; empty for values at points.
std::string meanWords(const ProbeSpec& spec, const std::string& lengthUnit) {
  const auto measured = [&](double length) {
    return fmt::format("{}{}{}", length, lengthUnit.empty() ? "" : " ", lengthUnit);
  };
  std::string words;
  if (spec.spot) words += fmt::format(", mean over a spot of {}", measured(*spec.spot));
  if (spec.window)
    words += fmt::format(", mean over {}{}", measured(*spec.window),
                         spec.point.empty() ? "" : " around the point");
  if (spec.penetration) words += fmt::format(", by X-rays of penetration {}", measured(*spec.penetration));
  if (spec.mean)
    words += fmt::format(", mean {} {}", spec.depth.empty() ? "along" : "below", pathWords(spec));
  return words;
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

/// The columns of a run: distance or time, of points where the material is and was, and the fields.
std::vector<std::string> columnsOf(const ProbeSpec& spec, const ProbedRun& run) {
  const std::string& unit = run.lengthUnit;
  std::vector<std::string> columns{spec.isOverTime() ? "time" : labelled("distance", unit)};
  const auto addAxes = [&](const char* axes) {
    for (int d = 0; d < run.dim; ++d) columns.push_back(labelled(std::string(1, axes[d]), unit));
  };
  if (!spec.mean) addAxes("xyz");
  if (!spec.mean && !run.isForeign) addAxes("XYZ");
  for (const FieldChoice& field : run.fields) columns.push_back(labelled(field.name, field.unit));
  if (!run.name.empty())
    for (std::string& column : columns) column = run.name + " " + column;
  return columns;
}

std::vector<std::string> cellsOf(const ProbeSpec& spec, const ProbedRun& run, const ProbePoint& point) {
  std::vector<std::string> cells{fmt::format("{}", point.at)};
  const auto add = [&](const Eigen::VectorXd& values) {
    for (const double value : values) cells.push_back(fmt::format("{}", value));
  };
  if (!spec.mean) add(point.current);
  if (!spec.mean && !run.isForeign) add(point.reference);
  add(point.values);
  return cells;
}

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

}  // namespace

ProbedRun withFormula(ProbedRun run, const ProbeSpec& spec) {
  if (spec.formula.empty()) return run;
  const Formula formula({spec.formula}, {}, formulaVariables(spec.fields));
  for (ProbePoint& point : run.points) {
    const double value =
        point.values.array().isNaN().any()
            ? ProbePoint::kNone
            : formula.at({point.values.data(), static_cast<std::size_t>(point.values.size())});
    point.values = Eigen::VectorXd::Constant(1, value);
  }
  FieldChoice made;
  made.name = made.words = spec.formulaName;
  run.fields = {std::move(made)};
  return run;
}

void requirePlace(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  withChosenBodies(model, frame, spec, [&](const ModelRecord& chosen, const FrameRecord& shown) {
    if (!spec.point.empty()) {
      const MaterialPoint point(chosen, pointOf(spec, chosen.dim), spec.window.value_or(0.0));
      return;
    }
    const ProbePath path = pathOf(spec, chosen.dim);
    const auto* laid = chosen.dim == 3 ? std::get_if<LaidPath>(&path) : nullptr;
    const LinePath* line = laid != nullptr ? &laid->line : std::get_if<LinePath>(&path);
    if (laid != nullptr) static_cast<void>(facePlace(chosen, shown, laid->address));
    if (line == nullptr)
      probedPath(chosen, shown, {chosen, shown, {"displacement"}}, path, {ProbedBody::Undeformed, 2, 0.0});
    else if (line->begin == line->end)  // the body may move to where it lies
      throw Error(fmt::format("line: found {}, a point twice; expected two points", spec.line));
  });
}

ProbedRun probedFrame(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec) {
  const bool ofContact = isOfContact(spec);
  return withChosenBodies(model, frame, spec, [&](const ModelRecord& chosen, const FrameRecord& shown) {
    if (ofContact) return withFormula(probedContact(chosen, shown, spec), spec);
    const ProbedFields fields = fieldsOf(chosen, shown, spec);
    return withFormula({"", chosen.dim, chosen.lengthUnit, fields.choices(),
                        probedPath(chosen, shown, fields, pathOf(spec, chosen.dim), optionsOf(spec))},
                       spec);
  });
}

ProbedRun probedHistory(const ResultReader& result, const std::vector<int>& frames, const ProbeSpec& spec) {
  ProbedRun run{"", result.model().dim, result.model().lengthUnit, {}, {}};
  std::optional<MaterialPoint> point;
  const bool ofContact = isOfContact(spec);
  const auto add = [&](const ModelRecord& model, const FrameRecord& frame) {
    if (ofContact) {
      run.fields = contactChoices(model, frame, spec);
      run.points.push_back(probedContactMean(model, frame, spec));
      return;
    }
    const ProbedFields fields = fieldsOf(model, frame, spec);
    if (!spec.point.empty() && !point)
      point.emplace(model, pointOf(spec, model.dim), spec.window.value_or(0.0));
    run.fields = fields.choices();
    run.points.push_back(point ? point->in(frame, fields)
                               : probedMean(model, frame, fields, pathOf(spec, model.dim), optionsOf(spec)));
  };
  for (const int index : frames) {
    throwIfInterrupted();
    withChosenBodies(result.model(), result.frame(index), spec, add);
  }
  if (std::ranges::all_of(run.points, [](const ProbePoint& p) { return p.values.array().isNaN().all(); }))
    throw Error("no point of the path is in a body with the field in any of the frames");
  return withFormula(std::move(run), spec);
}

std::vector<int> framesAt(const ResultReader& result, const std::vector<double>& times) {
  const std::vector<double> all = result.times();
  if (all.empty()) throw Error(fmt::format("{} has no frames yet", result.file().string()));
  if (times.empty()) return {static_cast<int>(all.size()) - 1};
  std::vector<int> frames;
  for (const double time : times) {
    const auto frame = std::ranges::find_if(all, [&](double own) { return isSameTime(own, time); });
    if (frame == all.end())
      throw Error(fmt::format("{} has no frame of the time {}", result.file().string(), time));
    frames.push_back(static_cast<int>(frame - all.begin()));
  }
  return frames;
}

std::vector<ProbedRun> probedRuns(const ResultReader& result, const ProbeSpec& spec,
                                  const std::vector<double>& times) {
  if (spec.isOverTime()) {
    if (result.numFrames() == 0) throw Error(fmt::format("{} has no frames yet", result.file().string()));
    std::vector<int> frames(static_cast<std::size_t>(result.numFrames()));
    std::iota(frames.begin(), frames.end(), 0);
    return {probedHistory(result, frames, spec)};
  }
  std::vector<ProbedRun> runs;
  for (const int index : framesAt(result, times)) {
    throwIfInterrupted();
    const FrameRecord frame = result.frame(index);
    runs.push_back(probedFrame(result.model(), frame, spec));
    if (times.size() > 1) runs.back().name = fmt::format("t = {:.6g}", frame.time);
  }
  return runs;
}

ProbeTitles titlesOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs) {
  CommonUnit length, value;
  for (const ProbedRun& run : runs) {
    if (!run.isForeign)
      length.add("the length of " + (run.name.empty() ? "the result" : run.name), run.lengthUnit);
    for (const FieldChoice& field : run.fields)
      if (!run.isForeign || !field.unit.empty()) value.add(field.name, field.unit);
  }
  return {spec.isOverTime() ? "Time" : withUnit(distanceWords(spec), length.text()),
          withUnit(fieldWords(runs.front().fields) + meanWords(spec, length.text()), value.text())};
}

std::vector<ChartCurve> curvesOf(const std::vector<ProbedRun>& runs) {
  std::vector<ChartCurve> curves;
  for (std::size_t field = 0; field < runs.front().fields.size(); ++field)
    for (const ProbedRun& run : runs) curves.push_back(curveOf(run, field));
  return curves;
}

Chart chartOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs) {
  const ProbeTitles titles = titlesOf(spec, runs);
  Chart chart;
  chart.x.title = titles.x;
  chart.y.title = titles.y;
  chart.curves = curvesOf(runs);
  return chart;
}

std::string tableOf(const ProbeSpec& spec, const std::vector<ProbedRun>& runs) {
  std::vector<std::string> titles;
  std::size_t rows = 0;
  for (const ProbedRun& run : runs) {
    const std::vector<std::string> columns = columnsOf(spec, run);
    titles.insert(titles.end(), columns.begin(), columns.end());
    rows = std::max(rows, run.points.size());
  }
  std::string text = csvRow(titles) + "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const ProbedRun& run : runs) {
      const std::vector<std::string> own = row < run.points.size()
                                               ? cellsOf(spec, run, run.points[row])
                                               : std::vector<std::string>(columnsOf(spec, run).size());
      cells.insert(cells.end(), own.begin(), own.end());
    }
    text += csvRow(cells) + "\n";
  }
  return text;
}

}  // namespace burnish
