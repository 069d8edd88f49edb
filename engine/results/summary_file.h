#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace burnish {

/// A condition that makes results doubtful from a time on.
struct DoubtRecord {
  std::string what;
  double firstTime = 0.0;
  int steps = 0;  ///< in which it held
};

/// What a run says about itself at its end, as stored in `summary.yaml` beside its result.
struct SummaryRecord {
  std::string program;  ///< as in the result's model: version and digest of the engine
  bool completed = false;
  std::string stoppedBecause;             ///< empty when completed
  std::string advice{};                   ///< what usually helps; may be empty
  std::vector<DoubtRecord> doubts;        ///< in the order of the first times
  std::map<std::string, double> numbers;  ///< steps, cut_backs, iterations, seconds, …: see docs/results.md
};

/// Throws `Error` if the file cannot be written.
void writeSummary(const std::filesystem::path& directory, const SummaryRecord& summary);

/// Throws `Error` if there is no summary in the directory or it is damaged.
SummaryRecord readSummary(const std::filesystem::path& directory);

/// A run removes the summary of an earlier one before it starts, so a summary means a run that has ended.
void removeSummary(const std::filesystem::path& directory);

}  // namespace burnish
