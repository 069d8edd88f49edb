#include "cli/jobs/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "engine/core/csv.h"
#include "engine/results/summary_file.h"

namespace burnish {
namespace {

struct Column {
  const char* entry;  ///< of the summary
  const char* title;
  int digits;  ///< significant ones
};

constexpr std::array kTableColumns{Column{"end_time", "end time", 6},
                                   Column{"steps", "steps", 9},
                                   Column{"cut_backs", "cut-backs", 9},
                                   Column{"smallest_step", "smallest step", 4},
                                   Column{"mean_iterations", "mean iter.", 3},
                                   Column{"max_iterations", "max iter.", 9},
                                   Column{"seconds", "seconds", 4}};

struct Row {
  std::string state;
  std::map<std::string, double> numbers{};  ///< of the summary; empty when the run has not ended well
};

Row rowOf(const PlannedRun& run, const std::vector<JobStatus>& jobs) {
  const JobState state = run.job ? jobs[*run.job].state : JobState::Fine;
  if (state == JobState::Failed) return {"failed"};
  if (state != JobState::Fine) return {"missing"};
  const RunAccount account = readSummary(run.directory);
  return {account.completed ? "completed" : "stopped", numbersOf(account)};
}

}  // namespace

std::string runsTable(const StudyPlan& plan, const std::vector<JobStatus>& jobs) {
  std::size_t width = 3;
  for (const PlannedRun& run : plan.runs) width = std::max(width, run.run->name.size());
  std::string text = fmt::format("{:<{}}  {:<9}", "run", width, "state");
  for (const Column& column : kTableColumns) text += fmt::format("  {}", column.title);
  text += "\n";
  for (const PlannedRun& run : plan.runs) {
    const Row row = rowOf(run, jobs);
    text += fmt::format("{:<{}}  {:<9}", run.run->name, width, row.state);
    if (!row.numbers.empty())
      for (const Column& column : kTableColumns)
        text += fmt::format("  {:>{}.{}g}", row.numbers.at(column.entry),
                            std::string_view(column.title).size(), column.digits);
    text += "\n";
  }
  return text;
}

Json::Value runsJson(const StudyPlan& plan, const std::vector<JobStatus>& jobs) {
  Json::Value list(Json::arrayValue);
  for (const PlannedRun& run : plan.runs) {
    const Row row = rowOf(run, jobs);
    Json::Value& added = list.append(Json::Value());
    added["name"] = run.run->name;
    added["state"] = row.state;
    added["directory"] = run.directory.string();
    for (const auto& [entry, number] : row.numbers) added[entry] = number;
  }
  return list;
}

std::string runsCsv(const StudyPlan& plan, const std::vector<JobStatus>& jobs) {
  std::vector<std::string> titles{"run", "state"};
  for (const Column& column : kTableColumns) titles.emplace_back(column.entry);
  std::string text = csvRow(titles) + "\n";
  for (const PlannedRun& run : plan.runs) {
    const Row row = rowOf(run, jobs);
    std::vector<std::string> cells{run.run->name, row.state};
    for (const Column& column : kTableColumns) {
      const auto number = row.numbers.find(column.entry);
      cells.push_back(number == row.numbers.end() ? "" : fmt::format("{}", number->second));
    }
    text += csvRow(cells) + "\n";
  }
  return text;
}

}  // namespace burnish
