#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/result_reader.h"
#include "engine/results/summary_file.h"

namespace burnish {

/// What a run has left in its directory, also one that still goes on or was killed.
struct RunRecord {
  std::string name;  ///< of the directory
  ResultReader result;
  std::optional<SummaryRecord> summary;  ///< of a run that has ended
  HistoryTable history, convergence;     ///< without columns if the file is missing

  /// A number of the summary, if there is one.
  std::optional<double> number(const std::string& entry) const;

  /// "completed", "stopped" or "not ended".
  std::string state() const;
};

/// Throws `Error` for a directory without a result and for damaged files.
RunRecord readRun(const std::filesystem::path& directory);

/// A column of a table, if it has it.
const std::vector<double>* findColumn(const HistoryTable& table, const std::string& name);

}  // namespace burnish
