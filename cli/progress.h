#pragma once
#include <chrono>
#include <string>

#include "engine/analysis/run.h"

namespace burnish {

/// "12:05" or "1:02:03".
std::string durationText(double seconds);

/// Step, time, iterations, cut-backs, elapsed and expected total time in one line of less than 80 columns.
std::string progressLine(const RunProgress& progress, double elapsedSeconds);

/// Shows on standard output how a run gets on: on a terminal one line that is written over, elsewhere a line
/// per step.
class Progress {
 public:
  Progress();
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const RunProgress& progress);

  /// Ends the line that is written over, before other output.
  void finish();

 private:
  bool terminal_;
  bool lineIsOpen_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace burnish
