#include "postproc/report/run_record.h"

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

std::string RunRecord::state() const {
  if (!account) return "not ended";
  return account->completed ? "completed" : "stopped";
}

RunRecord readRun(const fs::path& directory) {
  RunRecord run{nameOf(directory), ResultReader(directory), {}, {}, {}};
  if (fs::exists(directory / "summary.yaml")) run.account = readSummary(directory);
  run.history = tableIn(directory / "history.csv");
  run.convergence = tableIn(directory / "convergence.csv");
  return run;
}

}  // namespace burnish
