#include "postproc/study/run_outlook.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/same_time.h"
#include "postproc/scene/scene_fields.h"
#include "postproc/study/evidence/expression.h"
#include "postproc/study/measures.h"
#include "postproc/study/run_data.h"
#include "postproc/text/plain_time.h"

namespace burnish {
namespace {

/// Of a run that has frames, none of which is at this time.
std::string withoutFrame(const std::string& run, double time, const std::vector<double>& frames) {
  if (time > frames.back())
    return fmt::format("found {}, but the run {} ends at t = {}; allowed: a time up to then.", time, run,
                       plainTime(frames.back()));
  const auto after = std::ranges::upper_bound(frames, time);
  return fmt::format(
      "found {}, but the run {} has no frame at that time, the nearest ones are at {} and {}; allowed: a time of a "
      "frame, or output: {{times: [{}]}} in the scene of the run.",
      time, run, plainTime(*(after - 1)), plainTime(*after), time);
}

}  // namespace

RunOutlook outlookOf(const Scene& scene) {
  RunOutlook outlook{.dim = scene.dim(), .bodies = {}, .missingFields = {}, .frameTimes = {}, .columns = {}};
  for (const BodySpec& body : scene.bodies) outlook.bodies.push_back(body.name);
  for (const std::string& field : drawableFields())
    if (std::string problem = fieldProblem(scene, field); !problem.empty())
      outlook.missingFields.emplace(field, std::move(problem));
  return outlook;
}

const RunOutlook& OutlookReporter::of(const StudyRun& run) const {
  return outlooks_[static_cast<std::size_t>(&run - study().runs.data())];
}

RunReporter::Runs OutlookReporter::othersOf(const std::string& other, const Runs& runs) const {
  Runs others;
  for (const StudyRun* run : runs) others.push_back(&runNamed(study(), fillIn(other, run->parameters)));
  return others;
}

void OutlookReporter::requireColumns(const std::string& path, const std::string& formula,
                                     const Runs& runs) const {
  for (const StudyRun* run : runs) {
    const std::vector<std::string>& columns = of(*run).columns;
    if (columns.empty()) continue;
    const HistoryTable noRows{"run " + run->name, columns, std::vector<std::vector<double>>(columns.size())};
    if (!tryTo(path, [&] { evaluate(noRows, formula); })) return;
  }
}

void OutlookReporter::requireField(const std::string& path, const std::string& field,
                                   const Runs& runs) const {
  for (const StudyRun* run : runs) {
    const auto missing = of(*run).missingFields.find(field);
    if (missing != of(*run).missingFields.end())
      return report(path, fmt::format("run {}: {}", run->name, missing->second));
  }
}

void OutlookReporter::requireFrame(const std::string& path, double time, const Runs& runs) const {
  if (time == kEndOfRun) return;
  for (const StudyRun* run : runs) {
    const std::vector<double>& frames = of(*run).frameTimes;
    const auto isIt = [time](double frame) { return isSameTime(frame, time); };
    if (!frames.empty() && std::ranges::none_of(frames, isIt))
      return report(path, withoutFrame(run->name, time, frames));
  }
}

void OutlookReporter::requireFrames(const std::string& path, const std::vector<double>& times,
                                    const Runs& runs) const {
  for (std::size_t k = 0; k < times.size(); ++k) requireFrame(fmt::format("{}[{}]", path, k), times[k], runs);
}

void OutlookReporter::requireBodies(const std::string& path, const std::vector<std::string>& bodies,
                                    const Runs& runs) const {
  for (std::size_t k = 0; k < bodies.size(); ++k)
    for (const StudyRun* run : runs) {
      const RunOutlook& outlook = of(*run);
      if (outlook.dim == 0 || std::ranges::count(outlook.bodies, bodies[k]) > 0) continue;
      const std::string at = fmt::format("{}[{}]", path, k);
      if (!outlook.bodies.empty()) {
        requireKnown(at, bodies[k], outlook.bodies);
      } else {
        report(at, fmt::format("found {}, but the one body of the run {} has no name; leave the key out.",
                               bodies[k], run->name));
      }
      break;
    }
}

void OutlookReporter::requirePlane(const std::string& path, const char* what, const Runs& runs) const {
  for (const StudyRun* run : runs)
    if (of(*run).dim == 3)
      return report(path,
                    fmt::format("found the run {}, whose bodies have three dimensions; allowed for {}: two.",
                                run->name, what));
}

void OutlookReporter::requirePicture(const std::string& path, const PictureOptions& picture, const Runs& runs,
                                     const char* sizeKey) const {
  requireField(path + ".field", picture.field, runs);
  if (picture.threshold) requireField(path + ".threshold", picture.threshold->field, runs);
  if (picture.isosurfaces) requireField(path + ".isosurfaces", picture.isosurfaces->field, runs);
  requireBodies(path + ".body", picture.bodies, runs);
  for (const StudyRun* run : runs) {
    if (of(*run).dim == 0) continue;
    const std::vector<InputProblem> problems = conflictsIn(picture, of(*run).dim);
    for (const InputProblem& problem : problems)
      report(fmt::format("{}.{}", path, problem.path == "size" ? sizeKey : problem.path), problem.text);
    if (!problems.empty()) return;
  }
}

void OutlookReporter::requireMeasure(const std::string& path, const MeasureSpec& measure,
                                     const Runs& runs) const {
  const auto requireCurve = [&](const auto& curve, const Runs& ofRuns) {
    requireColumns(path + ".x", curve.x, ofRuns);
    requireColumns(path + ".y", curve.y, ofRuns);
    requireColumns(path + ".where", curve.where, ofRuns);
  };
  const auto requireTime = [&](const std::optional<double>& time, const Runs& ofRuns) {
    if (time) requireFrame(path + ".time", *time, ofRuns);
  };
  if (const auto* history = std::get_if<HistoryMeasure>(&measure.what)) requireCurve(*history, runs);
  if (const auto* difference = std::get_if<DifferenceMeasure>(&measure.what)) {
    Runs all = runs;
    tryTo(path + ".other",
          [&] { std::ranges::move(othersOf(difference->other, runs), std::back_inserter(all)); });
    requireCurve(*difference, all);
  }
  if (const auto* line = std::get_if<LineMeasure>(&measure.what)) {
    requirePlane(path + ".kind", "line", runs);
    requireField(path + ".field", line->field, runs);
    requireTime(line->time, runs);
  }
  if (const auto* depth = std::get_if<DepthMeasure>(&measure.what)) {
    requireBodies(path + ".body", depth->place.bodies, runs);
    requireTime(depth->time, runs);
  }
  if (const auto* section = std::get_if<SectionMeasure>(&measure.what)) {
    requireBodies(path + ".body", section->bodies, runs);
    requireTime(section->time, runs);
  }
  if (const auto* profile = std::get_if<ProfileMeasure>(&measure.what)) {
    Runs all = runs;
    tryTo(path + ".other",
          [&] { std::ranges::move(othersOf(profile->other, runs), std::back_inserter(all)); });
    for (const std::string& field : profile->place.fields) requireField(path + ".field", field, all);
    requireBodies(path + ".body", profile->place.bodies, all);
    requireTime(profile->time, all);
  }
  if (const auto* roughness = std::get_if<RoughnessMeasure>(&measure.what))
    requireTime(roughness->time, runs);
}

}  // namespace burnish
