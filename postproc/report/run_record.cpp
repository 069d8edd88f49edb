#include "postproc/report/run_record.h"

#include <algorithm>

namespace burnish {
namespace {

namespace fs = std::filesystem;

HistoryTable tableIn(const fs::path& file) {
  return fs::exists(file) ? readHistory(file) : HistoryTable{file, {}, {}};
}

/// The last part of a path that may end in a slash or be ".".
std::string nameOf(const fs::path& directory) {
  const fs::path whole = fs::weakly_canonical(directory);
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

std::optional<double> RunRecord::number(const std::string& entry) const {
  if (!summary || !summary->numbers.contains(entry)) return {};
  return summary->numbers.at(entry);
}

std::string RunRecord::state() const {
  if (!summary) return "not ended";
  return summary->completed ? "completed" : "stopped";
}

RunRecord readRun(const fs::path& directory) {
  RunRecord run{nameOf(directory), ResultReader(directory), {}, {}, {}};
  if (fs::exists(directory / "summary.yaml")) run.summary = readSummary(directory);
  run.history = tableIn(directory / "history.csv");
  run.convergence = tableIn(directory / "convergence.csv");
  return run;
}

const std::vector<double>* findColumn(const HistoryTable& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  return found == table.columns.end()
             ? nullptr
             : &table.values[static_cast<std::size_t>(found - table.columns.begin())];
}

}  // namespace burnish
