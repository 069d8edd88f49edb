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
  std::optional<RunAccount> account;  ///< of a run that has ended
  HistoryTable history, convergence;  ///< without columns if the file is missing

  /// "completed", "stopped" or "not ended".
  std::string state() const;
};

/// Throws `Error` for a directory without a result and for damaged files.
RunRecord readRun(const std::filesystem::path& directory);

}  // namespace burnish
