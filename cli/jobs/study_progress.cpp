#include "cli/jobs/study_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <deque>
#include <fstream>

#include "cli/console.h"
#include "cli/progress.h"
#include "engine/core/error.h"
#include "engine/results/summary_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string lastLines(const fs::path& file) {
  constexpr std::size_t shown = 5;
  std::ifstream stream(file);
  std::deque<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
    if (lines.size() > shown) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += "\n    " + line;
  return text.empty() ? " is empty" : " ends with" + text;
}

std::string failureText(const JobStatus& status, const fs::path& log) {
  const std::string how =
      status.signal != 0 ? fmt::format("killed by signal {} ({})", status.signal, ::strsignal(status.signal))
                         : fmt::format("exit code {}", status.exitCode);
  return fmt::format("failed ({}); {}{}", how, log.string(), lastLines(log));
}

std::string runText(const fs::path& directory) {
  try {
    const RunAccount summary = readSummary(directory);
    std::string text = fmt::format("{:.1f} s, {} steps, {} iterations, {} cut-backs", summary.timings.total,
                                   summary.steps, summary.iterations, summary.cuts);
    if (!summary.completed)
      text += fmt::format("; warning: stopped at t = {:.5g}: {}", summary.endTime, summary.stoppedBecause);
    return text;
  } catch (const Error& error) {
    return error.what();
  }
}

int numEnded(const std::vector<JobStatus>& all, const std::vector<std::size_t>& jobs) {
  return static_cast<int>(std::count_if(jobs.begin(), jobs.end(), [&](std::size_t job) {
    return all[job].state != JobState::Waiting && all[job].state != JobState::Running;
  }));
}

/// Time of the last complete row of a history that may still grow; 0 without one.
double lastTimeOf(const fs::path& history) {
  constexpr std::streamoff enough = 4096;  // for two rows
  std::ifstream file(history, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size <= 0) return 0.0;
  file.seekg(std::max<std::streamoff>(0, size - enough));
  std::string text(static_cast<std::size_t>(std::min(size, enough)), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));

  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return 0.0;
  const std::size_t before = text.rfind('\n', end - 1);
  const std::size_t comma = text.find(',', before == std::string::npos ? 0 : before);
  double time = 0.0;
  if (comma < end) std::from_chars(text.data() + comma + 1, text.data() + end, time);
  return time;
}

}  // namespace

StudyProgress::StudyProgress(const StudyPlan& plan)
    : plan_(plan), subjects_(plan.jobs.size()), terminal_(::isatty(STDOUT_FILENO) != 0) {
  for (const PlannedRun& run : plan.runs)
    if (run.job) subjects_[*run.job].run = &run;
  for (const PlannedFigure& figure : plan.figures)
    if (figure.job) subjects_[*figure.job].figure = &figure;
}

std::string StudyProgress::name(std::size_t job) const {
  const Subject& subject = subjects_[job];
  return subject.run != nullptr ? subject.run->run->name : "figure " + subject.figure->figure->name;
}

void StudyProgress::onEnd(std::size_t job, const std::vector<JobStatus>& all) {
  clear();
  if (all[job].state == JobState::Interrupted) return;
  printOut("{}: {}\n", name(job), endText(job, all));
  flushOutput();
}

std::string StudyProgress::endText(std::size_t job, const std::vector<JobStatus>& all) const {
  const JobStatus& status = all[job];
  if (status.state == JobState::Skipped)
    return fmt::format("skipped, because {} failed", name(status.blockedBy));
  if (status.state == JobState::Failed) return failureText(status, plan_.jobs[job].log);
  return subjects_[job].run != nullptr ? runText(subjects_[job].run->directory)
                                       : fmt::format("drawn in {:.1f} s", status.end - status.start);
}

void StudyProgress::onWait(const std::vector<JobStatus>& all) {
  constexpr auto pause = std::chrono::milliseconds(300);
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - lastShown_ < pause) return;
  clear();
  lastShown_ = now;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const auto show = [&, columns = terminalColumns()](const std::string& line) {
    printOut("{}\n", line.substr(0, columns - 1));
    ++linesShown_;
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].state == JobState::Running) show(runningText(i, seconds - all[i].start));
  show(overallText(all, seconds));
  flushOutput();
}

std::string StudyProgress::runningText(std::size_t job, double seconds) const {
  const PlannedRun* run = subjects_[job].run;
  if (run == nullptr) return fmt::format("  {}  {}", name(job), durationText(seconds));
  const double time = lastTimeOf(run->directory / "history.csv");
  return fmt::format("  {}  t {:.4g} of {:.4g}  {:.0f} %  {}", name(job), time, run->endTime,
                     100.0 * time / run->endTime, durationText(seconds));
}

double StudyProgress::shareDone(std::size_t job, const JobStatus& status) const {
  if (status.state == JobState::Waiting) return 0.0;
  if (status.state != JobState::Running) return 1.0;
  const PlannedRun& run = *subjects_[job].run;
  return std::min(1.0, lastTimeOf(run.directory / "history.csv") / run.endTime);
}

std::string StudyProgress::overallText(const std::vector<JobStatus>& all, double seconds) const {
  std::vector<std::size_t> runs, figures;
  double cost = 0.0, done = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    (subjects_[i].run != nullptr ? runs : figures).push_back(i);
    if (subjects_[i].run == nullptr) continue;
    cost += plan_.jobs[i].cost;
    done += plan_.jobs[i].cost * shareDone(i, all[i]);
  }
  const std::string rest = done > 0.0 && done < cost
                               ? fmt::format(", about {} to go", durationText(seconds * (cost - done) / done))
                               : "";
  return fmt::format("runs {} of {}, figures {} of {}; {}{}", numEnded(all, runs), runs.size(),
                     numEnded(all, figures), figures.size(), durationText(seconds), rest);
}

void StudyProgress::clear() {
  if (linesShown_ > 0) printOut("\x1b[{}A\x1b[J", linesShown_);
  linesShown_ = 0;
}

std::unique_ptr<JobObserver> progressOf(const StudyPlan& plan, bool isShown) {
  struct Nothing : JobObserver {
    void onEnd(std::size_t, const std::vector<JobStatus>&) override {}
    void onWait(const std::vector<JobStatus>&) override {}
  };
  if (isShown) return std::make_unique<StudyProgress>(plan);
  return std::make_unique<Nothing>();
}

}  // namespace burnish
