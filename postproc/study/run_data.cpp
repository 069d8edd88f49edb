#include "postproc/study/run_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "engine/core/same_time.h"

namespace burnish {
namespace {

RunAccount summaryOf(const StudyRun& run, const std::filesystem::path& studyDirectory) {
  if (!hasEnded(run, studyDirectory))
    throw Error(fmt::format("run {}: there are no results in {}", run.name,
                            runDirectory(studyDirectory, run).string()));
  return readSummary(runDirectory(studyDirectory, run));
}

}  // namespace

RunData::RunData(const StudyRun& run, const std::filesystem::path& studyDirectory)
    : run_(run), directory_(runDirectory(studyDirectory, run)), summary_(summaryOf(run, studyDirectory)) {}

std::optional<double> RunData::stoppedAt() const {
  if (summary_.completed) return {};
  return number("end_time");
}

double RunData::number(const std::string& entry) const {
  const std::map<std::string, double> numbers = numbersOf(summary_);
  if (const auto found = numbers.find(entry); found != numbers.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : numbers) names.push_back(name);
  throw Error(fmt::format("run {}: its summary has no \"{}\"; it has {}.{}", run_.name, entry,
                          fmt::join(names, ", "), didYouMean(entry, names)));
}

bool hasEnded(const StudyRun& run, const std::filesystem::path& studyDirectory) {
  return std::filesystem::exists(runDirectory(studyDirectory, run) / "summary.yaml");
}

std::string stoppedText(double time) {
  return fmt::format("stopped at t = {:.4g}", time);
}

FrameAt frameAt(const RunData& data, const ResultReader& result, double time) {
  const std::vector<double> times = result.times();
  const auto found = std::ranges::find_if(times, [&](double t) { return isSameTime(t, time); });
  if (found != times.end()) return {result.frame(static_cast<int>(found - times.begin()))};
  const auto stopped = data.stoppedAt();
  if (time == kEndOfRun && !times.empty())
    return {result.frame(static_cast<int>(times.size()) - 1), stopped.has_value()};
  if (stopped && *stopped < time && !times.empty())
    return {result.frame(static_cast<int>(times.size()) - 1), true};
  throw Error(fmt::format("run {}: there is no frame at t = {:.6g}; its frames are at t = {:.6g}",
                          data.run().name, time, fmt::join(times, ", ")));
}

}  // namespace burnish
