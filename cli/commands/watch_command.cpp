#include <fmt/format.h>
#include <json/value.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/command.h"
#include "cli/commands/watch_page.h"
#include "cli/console.h"
#include "cli/faults.h"
#include "cli/jobs/child_process.h"
#include "cli/watch/followed_run.h"
#include "cli/watch/text_chart.h"
#include "engine/core/error.h"
#include "engine/results/run_files.h"
#include "postproc/text/account_text.h"
#include "postproc/text/json_text.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

struct WatchArguments {
  fs::path directory;
  std::string column;
  fs::path page;
  std::string onFrame;
  double patience = 60.0;
  bool waits = false, json = false;
};

/// The column that was asked for; else the first force across a face, or the energy.
std::string columnOf(const WatchArguments& arguments, const HistoryTable& history) {
  if (!arguments.column.empty()) {
    if (history.numRows() > 0) history.column(arguments.column);  // throws if there is none
    return arguments.column;
  }
  for (const char* ending : {".fy", ".fz", ".fx"})
    for (const std::string& column : history.columns)
      if (column.ends_with(ending)) return column;
  return "strain_energy";
}

/// Whether the terminal shows letters of Unicode.
bool hasUnicode() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (const char* locale = std::getenv(variable); locale != nullptr && *locale != '\0')
      return std::string_view(locale).find("UTF-8") != std::string_view::npos ||
             std::string_view(locale).find("utf8") != std::string_view::npos;
  return false;
}

std::string lineOf(const RunState& state) {
  std::string line = fmt::format("step {}  t {:.5g}", state.step, state.time);
  if (state.endTime) line += fmt::format(" of {:.5g}", *state.endTime);
  if (state.residual) line += fmt::format("  residual {:.2e}", *state.residual);
  return line + fmt::format("  frames {}", state.frames.size());
}

std::string jsonOf(const RunState& state) {
  Json::Value value;
  value["step"] = state.step;
  value["time"] = state.time;
  if (state.endTime) value["end_time"] = *state.endTime;
  if (state.residual) value["residual"] = *state.residual;
  value["frames"] = static_cast<Json::UInt64>(state.frames.size());
  if (!state.picture.empty()) value["picture"] = state.picture.string();
  if (state.account) {
    value["completed"] = state.account->completed;
    if (!state.account->completed) value["stopped_because"] = state.account->stoppedBecause;
  }
  return compactText(value, kJsonDigits);
}

/// Shows states one after the other: on a terminal over one another with a chart, elsewhere a line each.
class WatchDisplay {
 public:
  explicit WatchDisplay(const WatchArguments& arguments)
      : arguments_(arguments), isTerminal_(::isatty(STDOUT_FILENO) != 0 && !arguments.json) {}

  void show(const RunState& state) {
    if (isTerminal_) {
      showOver(state);
    } else {
      const std::string line = arguments_.json ? jsonOf(state) : lineOf(state);
      if (line != last_) printOut("{}\n", line);
      last_ = line;
      if (!arguments_.json && state.picture != picture_) printOut("picture {}\n", state.picture.string());
      picture_ = state.picture;
    }
    flushOutput();
  }

 private:
  void showOver(const RunState& state) {
    std::vector<std::string> lines{lineOf(state)};
    if (!state.picture.empty()) lines.push_back("picture " + state.picture.string());
    const std::string column = columnOf(arguments_, state.history);
    if (const auto* values = findColumn(state.history, column)) {
      const auto chart = chartLines({.x = state.history.column("time"),
                                     .y = *values,
                                     .end = state.endTime.value_or(state.time),
                                     .columns = std::min(60, static_cast<int>(terminalColumns()) - 14),
                                     .blocks = hasUnicode()});
      if (!chart.empty()) lines.push_back(column);
      lines.insert(lines.end(), chart.begin(), chart.end());
    }
    if (shown_ > 0) printOut("\x1b[{}A\x1b[J", shown_);
    for (const std::string& line : lines) printOut("{}\n", line);
    shown_ = 0;
    for (const std::string& line : lines) shown_ += rowsOf(line);
  }

  /// Rows of the terminal that a line takes; letters of more than a byte count once.
  static int rowsOf(const std::string& line) {
    const auto letters =
        std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    const auto columns = static_cast<long>(terminalColumns());
    return static_cast<int>(std::max(1l, (static_cast<long>(letters) + columns - 1) / columns));
  }

  const WatchArguments& arguments_;
  bool isTerminal_;
  int shown_ = 0;  ///< rows of the terminal
  std::string last_;
  fs::path picture_;
};

/// Runs the command for the frames from `first` on; how many failed.
int callFor(const WatchArguments& arguments, const RunState& state, std::size_t first) {
  int failed = 0;
  for (std::size_t k = first; k < state.frames.size(); ++k) {
    ::setenv("BURNISH_RESULT", arguments.directory.c_str(), 1);
    ::setenv("BURNISH_FRAME", std::to_string(k).c_str(), 1);
    ::setenv("BURNISH_TIME", fmt::format("{}", state.frames[k]).c_str(), 1);
    flushOutput();
    if (std::system(arguments.onFrame.c_str()) == 0) continue;
    printError("warning: --on-frame: the command failed for frame {} at t = {}\n", k, state.frames[k]);
    ++failed;
  }
  return failed;
}

void requireRun(const WatchArguments& arguments, const FollowedRun& run) {
  std::error_code status;
  if (fs::exists(arguments.directory, status) && !fs::is_directory(arguments.directory, status))
    throw Error(fmt::format("{}: this is a file; expected the directory of a run, such as out/press",
                            arguments.directory.string()));
  if (arguments.waits || run.hasBegun() || run.isHeld()) return;
  throw Error(fmt::format("{}: {}; start the run first, or add --wait", arguments.directory.string(),
                          fs::is_directory(arguments.directory, status) ? "there is no run in it"
                                                                        : "there is no such directory"));
}

ExitCode endOfWatch(const WatchArguments& arguments, const RunState& state, const std::string& problem,
                    int failed) {
  if (!state.account) {
    if (!problem.empty()) throw Error(problem);
    const bool canGoOn = canBeResumed(arguments.directory);
    throw Error(fmt::format(
        "{}: the run is not at work any more and has not come to its end{}", arguments.directory.string(),
        canGoOn ? "; go on with: burnish run --resume " + arguments.directory.string() : ""));
  }
  for (const std::string& warning : warningsOf(*state.account)) printError("warning: {}\n", warning);
  if (!state.account->completed) {
    printError("burnish: the run did not reach its end: {}\n", state.account->stoppedBecause);
    return ExitCode::Stopped;
  }
  return failed > 0 ? ExitCode::Incomplete : ExitCode::Fine;
}

ExitCode watch(const WatchArguments& arguments) {
  constexpr auto pause = std::chrono::milliseconds(250);
  const SignalGuard signals(SecondSignal::Ends);
  if (!arguments.page.empty() && arguments.page.extension() != ".html")
    throw Error(fmt::format("--page: found \"{}\"; expected the name of a page that ends in .html",
                            arguments.page.string()));
  FollowedRun run(arguments.directory);
  requireRun(arguments, run);
  WatchDisplay display(arguments);
  int failed = 0;
  std::size_t known = 0;  // frames that are not new
  bool isFirst = true;
  for (auto lastSign = Clock::now();; std::this_thread::sleep_for(pause)) {
    if (signals.count() > 0) return codeOfSignal(signals.signal());
    const bool isHeld = run.isHeld();  // before the files: they are complete when it is not held
    const bool isNew = run.look();
    const RunState& state = run.state();
    const std::string column = columnOf(arguments, state.history);
    if (isNew || isHeld) lastSign = Clock::now();
    if (isNew && (run.hasBegun() || state.account)) {
      display.show(state);
      if (!isFirst && !arguments.onFrame.empty())
        failed += callFor(arguments, state, std::min(known, state.frames.size()));
      known = state.frames.size();
      if (!arguments.page.empty()) writeWatchPage(arguments.directory, state, column, arguments.page);
    }
    isFirst = false;
    // A run draws its last pictures behind its summary.
    const bool isGone = Clock::now() - lastSign > std::chrono::duration<double>(arguments.patience);
    if (!isHeld && (state.account || (isGone && !arguments.waits) || (isGone && run.hasBegun())) &&
        !run.look())
      return endOfWatch(arguments, state, run.problem(), failed);
  }
}

}  // namespace

void addWatchCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("watch", "Follow a run from outside until it ends");
  command->footer(
      "Exit codes: 0 the run has come to its end, 2 it is gone without an end, 3 it stopped before, 4 a command of\n"
      "--on-frame failed.");
  const auto arguments = std::make_shared<WatchArguments>();
  command->add_option("DIR", arguments->directory, "Directory of a run")->required();
  command
      ->add_option("--y", arguments->column,
                   "Column of the history that is drawn [the first force, or strain_energy]")
      ->type_name("COLUMN");
  command->add_option("--page", arguments->page, "Also write a page that loads itself again")
      ->type_name("PAGE.html");
  command
      ->add_option(
          "--on-frame", arguments->onFrame,
          "Command of the shell for every frame that comes; it finds the directory, the frame and its time in "
          "BURNISH_RESULT, BURNISH_FRAME and BURNISH_TIME")
      ->type_name("CMD");
  command->add_flag("--wait", arguments->waits, "Wait for a run that has not begun");
  command
      ->add_option(
          "--patience", arguments->patience,
          "Seconds without anything new after which a run that no process of this machine holds is gone [60]")
      ->check(CLI::Range(0.1, 1e6))
      ->type_name("SECONDS");
  command->add_flag("--json", arguments->json, "Print a JSON object per line instead");
  command->callback([&action, arguments] { action = [arguments] { return watch(*arguments); }; });
}

}  // namespace burnish
