#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/results/history.h"
#include "engine/results/run_account.h"

namespace burnish {

/// What the files in the directory of a run say of it, while it goes on or behind its end.
struct RunState {
  int step = 0;
  double time = 0.0;
  std::optional<double> endTime;   ///< of the scene; known once the run has begun
  std::optional<double> residual;  ///< of the last iteration that was written
  std::vector<double> frames;      ///< their times
  std::filesystem::path picture;   ///< the newest one, or none
  HistoryTable history;
  std::optional<RunAccount> account;  ///< once the run has ended
};

/// A run that is followed from outside, through its files alone: it may compute on another machine.
class FollowedRun {
 public:
  explicit FollowedRun(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// Looks again; whether there is anything new. What cannot be read at the moment stays as it was.
  bool look();

  const RunState& state() const { return state_; }

  /// What could not be read at the last look; empty: all could.
  const std::string& problem() const { return problem_; }

  /// Whether a run has left anything in the directory.
  bool hasBegun() const;

  /// Whether a process of this machine holds the directory, as runs do.
  bool isHeld() const;

 private:
  void readHistoryFile();
  /// What fails is tried again by the next look: files may be on the way to their places.
  void read(const std::function<void()>& act);

  std::filesystem::path directory_;
  RunState state_;
  std::string seen_;     ///< sizes and times of the files
  std::string problem_;  ///< what could not be read at the last look
};

}  // namespace burnish
