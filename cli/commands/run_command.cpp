#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/commands/run_events.h"
#include "cli/commands/run_outputs.h"
#include "cli/console.h"
#include "cli/faults.h"
#include "cli/jobs/child_process.h"
#include "cli/late_vtk.h"
#include "cli/ranks.h"
#include "cli/scene_input.h"
#include "engine/core/error.h"
#include "engine/results/history.h"
#include "engine/results/run_files.h"
#include "postproc/offscreen/offscreen_canvas.h"
#include "postproc/scene/scene_document.h"
#include "postproc/text/account_text.h"

namespace burnish {
namespace {

struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path directory;
  bool resumes = false;    ///< --resume
  bool continues = false;  ///< --continue
  std::vector<std::string> overrides;
  int threads = 0;
  bool quiet = false;
  bool json = false;
  bool timings = false;
  bool noDoubts = false;
};

void printLine(const std::string& name, const std::string& text) {
  printOut("  {:<22}{}\n", name, text);
}

void printAccount(const RunSummary& summary, const HistoryTable& history) {
  const double seconds = summary.timings.total;
  printOut("{} {} s\n", summary.completed ? "completed in" : "stopped after",
           seconds < 100.0 ? fmt::format("{:.3g}", seconds) : fmt::format("{:.0f}", seconds));
  printLine("frames", std::to_string(summary.frames));
  for (const auto& [name, text] : accountLines(summary, history)) printLine(name, text);
}

void printTimings(const RunSummary& summary) {
  printText("timings\n");
  for (const auto& [part, seconds] : timingsTable(summary))
    printLine(part, fmt::format("{:8.3f} s", seconds));
  const RunTimings& t = summary.timings;
  const double perIteration = 1000.0 * (t.assembly + t.contact + t.factorisation + t.solve) /
                              static_cast<double>(std::max(1l, summary.iterations));
  printLine("a Newton iteration", fmt::format("{:.2f} ms on average", perIteration));
}

/// How several processes have divided the work.
void printRanks(const RunSummary& summary) {
  int assembled = 0;
  for (std::size_t r = 0; r < summary.ranks.size(); ++r) {
    const RankWork& rank = summary.ranks[r];
    assembled += rank.spans;
    printLine(fmt::format("rank {}", r),
              fmt::format("{} spans, {:.3g} million entries of the tangent, {:.3g} MB sent", rank.spans,
                          1e-6 * rank.entries, 1e-6 * rank.bytesSent));
  }
  printLine("spans assembled", fmt::format("{} of {}: {:.2f} times", assembled, summary.spans,
                                           static_cast<double>(assembled) / summary.spans));
}

void printResults(const RunArguments& arguments, const RunSummary& summary, const RunOutputs& outputs) {
  printAccount(summary, readHistory(arguments.directory / "history.csv"));
  if (arguments.timings) printTimings(summary);
  if (arguments.timings && !summary.ranks.empty()) printRanks(summary);
  printOut("results in {}\n", arguments.directory.string());
  for (const auto& picture : outputs.pictures()) printOut("  picture {}\n", picture.string());
}

std::string howToResume(const std::filesystem::path& directory) {
  return fmt::format("go on with: burnish run --resume {}", directory.string());
}

/// As the first rank finds it before it writes.
bool canBeContinued(const std::filesystem::path& directory) {
  bool can = false;
  ranks().first([&] { can = canBeResumed(directory); });
  return ranks().any(can);
}

RunSummary compute(const Scene& scene, const RunArguments& arguments, const SignalGuard& signals,
                   RunOutputs& outputs) {
  const RunOptions options{
      .threads = arguments.threads, .halt = [&] { return signals.count() > 0; }, .team = &ranks()};
  try {
    if (arguments.continues && canBeContinued(arguments.directory)) {
      try {
        return resumeRun(scene, arguments.directory, options, outputs);
      } catch (const Error& error) {
        if (outputs.hasStarted()) throw;
        printError("burnish: begins anew: {}\n", error.what());
      }
    }
    return arguments.resumes ? resumeRun(scene, arguments.directory, options, outputs)
                             : runScene(scene, arguments.directory, options, outputs);
  } catch (const Error& error) {
    if (!outputs.hasStarted() || !canBeResumed(arguments.directory)) throw;
    throw Error(fmt::format("{}\nburnish: the results up to the last frame are kept; when this is mended, {}",
                            error.what(), howToResume(arguments.directory)));
  }
}

/// Tells which pictures are missing, why, and how to draw them.
void reportMissing(const RunOutputs& outputs) {
  int interrupted = 0;
  for (const auto& [what, file, reason, command] : outputs.missing()) {
    if (!reason.empty())
      printError(
          "burnish: the {} {} was not drawn: {}; the results are there; once that is mended, this draws it: {}\n",
          what, file.string(), reason, command);
    else if (interrupted++ == 0)
      printError(
          "burnish: interrupted by a signal before all pictures were drawn; the results are complete, "
          "this draws the next one: {}\n",
          command);
  }
}

ExitCode reportEnd(const RunArguments& arguments, const RunSummary& summary, const RunOutputs& outputs,
                   int signal) {
  for (const std::string& warning : warningsOf(summary)) printError("warning: {}\n", warning);
  if (!summary.halted) reportMissing(outputs);  // a run that goes on draws them
  if (summary.completed && outputs.missing().empty()) return ExitCode::Fine;
  if (summary.completed) return signal == 0 ? ExitCode::Incomplete : codeOfSignal(signal);
  if (summary.halted) {
    printError("burnish: {} by a signal; nothing is lost; {}\n", summary.stoppedBecause,
               howToResume(arguments.directory));
    return codeOfSignal(signal);
  }
  printError("burnish: the run did not reach its end: {}; the results up to there are kept\n",
             summary.stoppedBecause);
  if (!summary.advice.empty()) printError("burnish: what usually helps: {}\n", summary.advice);
  return ExitCode::Stopped;
}

ExitCode run(const RunArguments& arguments) {
  const SceneDocument document = arguments.resumes ? readResultDocument(arguments.directory)
                                                   : readSceneInput(arguments.scene, arguments.overrides);
  OffscreenCanvas::saveMemory();  // for the solver
  const SignalGuard signals(SecondSignal::Ends);
  const RunReport report = arguments.json    ? RunReport::Events
                           : arguments.quiet ? RunReport::Nothing
                                             : RunReport::Progress;
  RunOutputs outputs(document, arguments.directory, report, !arguments.noDoubts);
  ranks().first([&] {
    if (!arguments.resumes) outputs.takeDirectory();
    if (outputs.needVtk()) loadVtk();  // what would fail later fails before anything is computed
  });
  const RunSummary summary = compute(document.scene, arguments, signals, outputs);
  ranks().first([&] {
    if (!summary.halted) outputs.finish(!summary.doubts.empty());
    if (arguments.json)
      printEndEvent(summary, arguments.directory);
    else if (!arguments.quiet)
      printResults(arguments, summary, outputs);
  });
  flushOutput();
  return reportEnd(arguments, summary, outputs, signals.signal());
}

bool isComplete(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / "summary.yaml") && readSummary(directory).completed;
}

ExitCode runOrResume(RunArguments arguments) {
  if (arguments.resumes && isComplete(arguments.directory)) {
    printOut("the run in {} has come to its end; there is nothing to resume\n", arguments.directory.string());
    return ExitCode::Fine;
  }
  requireDirectoryName(arguments.resumes ? "--resume" : "-o", arguments.directory);
  if (isStandardInput(arguments.scene)) {
    if (arguments.directory.empty())
      throw Error("-o: missing; a scene on standard input has no name for the directory of its results");
    if (!ranks().isAlone())
      throw Error("-: standard input reaches one of several processes alone; give all of them a file");
  }
  if (!arguments.resumes && arguments.directory.empty())
    arguments.directory = std::filesystem::path("out") / arguments.scene.stem();
  return run(arguments);
}

}  // namespace

void addRunCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Compute a scene; write results, VTU files and pictures");
  const auto arguments = std::make_shared<RunArguments>();
  command->footer(
      "Exit codes: 0 done, 2 unusable input, 3 the run stopped before its end, 4 all is computed but a "
      "picture\n"
      "failed, 130 and 143 interrupted. What was computed is kept.");
  CLI::Option* scene =
      command->add_option("SCENE", arguments->scene, "Scene file (YAML); - for a scene on standard input");
  CLI::Option* output = command
                            ->add_option("-o,--output", arguments->directory,
                                         "Directory for everything that is written [out/NAME of the scene]")
                            ->type_name("DIR");
  CLI::Option* set = command
                         ->add_option("--set", arguments->overrides,
                                      "path=value: change an entry of the scene, e.g. --set degree=3; may be "
                                      "repeated")
                         ->type_name("PATH=VALUE")
                         ->allow_extra_args(false);
  command->add_flag(
      "--continue", arguments->continues,
      "Go on with the run in the output directory if it was stopped and is of the same scene; else "
      "begin anew");
  command
      ->add_option_function<std::string>(
          "--resume",
          [arguments](const std::string& directory) {
            arguments->directory = directory;
            arguments->resumes = true;
          },
          "Go on with the run that was stopped in this directory, instead of SCENE")
      ->type_name("DIR")
      ->excludes(scene)
      ->excludes(output)
      ->excludes(set);
  command->add_option("--threads", arguments->threads, "Number of threads; results do not depend on it [all]")
      ->check(CLI::Range(1, 1024));
  CLI::Option* quiet = command->add_flag("--quiet", arguments->quiet, "Print errors and warnings only");
  CLI::Option* timings = command->add_flag("--timings", arguments->timings, "Print where the time went");
  command
      ->add_flag("--json", arguments->json,
                 "Print a JSON object in a line for every step, frame and picture, and for the end")
      ->excludes(quiet)
      ->excludes(timings);
  command->add_flag("--no-doubts", arguments->noDoubts,
                    "Do not mark pictures of results that the run doubts");
  command->callback([&action, arguments] {
    if (arguments->scene.empty() && !arguments->resumes) throw CLI::RequiredError("SCENE or --resume DIR");
    action = [arguments] { return runOrResume(*arguments); };
  });
}

}  // namespace burnish
