#include "postproc/study/study_reporter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <variant>

#include "engine/core/nearest.h"
#include "engine/results/run_account.h"

namespace burnish {

void StudyReporter::requireKnown(const std::string& path, const std::string& name,
                                 const std::vector<std::string>& names) const {
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string allowed = names.empty() ? "there are none" : fmt::format("{}", fmt::join(names, " | "));
  report(path, fmt::format("found {}; allowed: {}.{}", name, allowed, didYouMean(name, names)));
}

void StudyReporter::requireSameLength(const std::string& path, std::size_t found, const std::string& of,
                                      std::size_t wanted) const {
  if (found != 0 && found != wanted)
    report(path, fmt::format("found a list of {}; allowed: a list of {}, one for each of the {}, or none.",
                             found, wanted, of));
}

void StudyReporter::checkPicture(const std::string& path, const PictureOptions& picture,
                                 const char* sizeKey) const {
  for (const InputProblem& problem : conflictsIn(picture, {}))
    report(fmt::format("{}.{}", path, problem.path == "size" ? sizeKey : problem.path), problem.text);
}

void StudyReporter::checkMeasure(const std::string& path, const MeasureSpec& measure) const {
  const auto checkPlace = [&](const ProbeSpec& place) {
    for (const InputProblem& problem : conflictsIn(place)) report(path + "." + problem.path, problem.text);
  };
  if (const auto* depth = std::get_if<DepthMeasure>(&measure.what)) checkPlace(depth->place);
  if (const auto* profile = std::get_if<ProfileMeasure>(&measure.what)) {
    checkPlace(profile->place);
    if (profile->place.fields.size() != 1)
      report(path + ".field", fmt::format("found {} fields; allowed: one.", profile->place.fields.size()));
  }
  if (const auto* roughness = std::get_if<RoughnessMeasure>(&measure.what))
    for (const InputProblem& problem : mistakesIn(roughness->face))
      report(path + "." + problem.path, problem.text);
  if (const auto* summary = std::get_if<SummaryMeasure>(&measure.what))
    requireKnown(path + ".entry", summary->entry, numberNames());
  const auto* history = std::get_if<HistoryMeasure>(&measure.what);
  if (history == nullptr) return;
  const bool isAt = history->reduce == Reduction::At;
  if (isAt && !history->at) report(path + ".at", "missing; required with `reduce: at`: a number.");
  if (!isAt && history->at)
    report(path + ".at", "found without `reduce: at`; allowed: only together with it.");
}

RunReporter::Runs RunReporter::runsOf(const std::string& path,
                                      const std::vector<std::string>& patterns) const {
  bool allFound = true;
  for (std::size_t i = 0; i < patterns.size(); ++i)
    allFound = tryTo(fmt::format("{}[{}]", path, i), [&] { study_.matching({patterns[i]}); }) && allFound;
  return allFound ? study_.matching(patterns) : Runs{};
}

void RunReporter::requireParameter(const std::string& path, const std::optional<std::string>& name,
                                   const Runs& runs) const {
  if (!name || runs.empty()) return;
  std::set<std::string> names;
  for (const StudyRun* run : runs)
    for (const auto& entry : run->parameters)
      if (!entry.first.ends_with(".label")) names.insert(entry.first);
  requireKnown(path, *name, {names.begin(), names.end()});
}

void RunReporter::checkLooks(const std::string& path, const CurveLooks& looks, const Runs& runs) const {
  requireParameter(path + ".looks.color", looks.color, runs);
  requireParameter(path + ".looks.dash", looks.dash, runs);
  requireParameter(path + ".looks.marker", looks.marker, runs);
}

void RunReporter::checkReferences(const std::string& path, const MeasureSpec& measure,
                                  const Runs& runs) const {
  const auto* difference = std::get_if<DifferenceMeasure>(&measure.what);
  const auto* profile = std::get_if<ProfileMeasure>(&measure.what);
  if (difference == nullptr && profile == nullptr) return;
  const std::string& other = difference != nullptr ? difference->other : profile->other;
  for (const StudyRun* run : runs)
    if (!checkRunName(path + ".other", other, run->parameters)) return;
}

bool RunReporter::checkRunName(const std::string& path, const std::string& text,
                               const std::map<std::string, std::string>& parameters) const {
  return tryTo(path, [&] {
    const std::string name = fillIn(text, parameters);
    const auto names = namesOf(study_.runs);
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(fmt::format("found {}, which is no run.{}", name, didYouMean(name, names)));
  });
}

}  // namespace burnish
