#include "cli/progress.h"
#include "cli/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace burnish {

std::string durationText(double seconds) {
  const long total = std::lround(seconds);
  const long hours = total / 3600, minutes = total / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60);
  return fmt::format("{}:{:02}", minutes, total % 60);
}

std::string progressLine(const RunProgress& progress, double elapsedSeconds) {
  const double share = progress.time / progress.endTime;
  const std::string expected = share > 0.0 ? durationText(elapsedSeconds / share) : "?";
  return fmt::format("step {}  t {:.5g} of {:.5g}  iterations {}  cut-backs {}  {} of about {}",
                     progress.step, progress.time, progress.endTime, progress.iterations, progress.totalCuts,
                     durationText(elapsedSeconds), expected);
}

Progress::Progress() : terminal_(::isatty(STDOUT_FILENO) != 0) {}

void Progress::show(const RunProgress& progress) {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const std::string line = progressLine(progress, elapsed.count());
  if (terminal_)
    printOut("\r{}\x1b[K", line);
  else
    printOut("{}\n", line);
  flushOutput();
  lineIsOpen_ = terminal_;
}

void Progress::finish() {
  if (lineIsOpen_) printOut("\n");
  lineIsOpen_ = false;
}

}  // namespace burnish
