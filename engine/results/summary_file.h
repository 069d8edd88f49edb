#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/results/reaction_record.h"

namespace burnish {

/// A condition that makes results doubtful from a time on.
struct DoubtRecord {
  std::string what;
  double firstTime = 0.0;
  int steps = 0;         ///< in which it held
  std::string detail{};  ///< how bad it was at its worst, and what would do; may be empty
};

/// The body meshed anew.
struct RezoningRecord {
  double time = 0.0;
  double energyLost = 0.0;     ///< strain energy that the transfer and the new equilibrium cost
  double gapWork = 0.0;        ///< on the body at the resting tool, as the gaps are closed that it began with
  double volumeDrift = 0.0;    ///< stress-free volume over that at the start of the run, minus one
  double boundaryError = 0.0;  ///< distance of the new boundary from the old one along its normal
  double quality = 0.0;        ///< smallest over largest determinant of the new mesh's map
  double smallestSpan = 0.0;   ///< length of the smallest knot span along the contact face
  int iterations = 0;          ///< to equilibrium on the new mesh
};

/// What a run says about itself at its end, as stored in `summary.yaml` beside its result.
struct SummaryRecord {
  std::string program;  ///< as in the result's model: version and digest of the engine
  bool completed = false;
  std::string stoppedBecause;               ///< empty when completed
  std::string advice{};                     ///< what usually helps; may be empty
  std::vector<DoubtRecord> doubts;          ///< in the order of the first times
  std::vector<std::string> warnings{};      ///< of the scene, with their keys: what is probably not meant
  std::vector<std::string> idleTools{};     ///< with contact pairs, but never in touch
  std::vector<ReactionRecord> reactions{};  ///< one per support
  std::vector<RezoningRecord> rezonings{};
  std::string rezoningFailure{};          ///< why the last one failed that did; may be empty
  std::map<std::string, double> numbers;  ///< steps, cut_backs, iterations, seconds, …: see docs/results.md
};

/// Throws `Error` if the file cannot be written.
void writeSummary(const std::filesystem::path& directory, const SummaryRecord& summary);

/// Throws `Error` if there is no summary in the directory or it is damaged. Entries that this version does
/// not know are passed over.
SummaryRecord readSummary(const std::filesystem::path& directory);

/// A run removes the summary of an earlier one before it starts, so a summary means a run that has ended.
void removeSummary(const std::filesystem::path& directory);

}  // namespace burnish
