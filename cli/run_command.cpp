#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/child_process.h"
#include "cli/command.h"
#include "cli/run_outputs.h"
#include "cli/summary_text.h"
#include "engine/core/error.h"
#include "engine/results/run_files.h"
#include "engine/scene/reader.h"
#include "postproc/offscreen/offscreen_canvas.h"

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
  bool timings = false;
  bool noDoubts = false;
};

void printResults(const RunArguments& arguments, const RunSummary& summary, const RunOutputs& outputs) {
  fmt::print("{}", summaryText(summary));
  if (arguments.timings) fmt::print("{}", timingsText(summary));
  fmt::print("results in {}\n", arguments.directory.string());
  for (const auto& picture : outputs.pictures()) fmt::print("  picture {}\n", picture.string());
}

std::string howToResume(const std::filesystem::path& directory) {
  return fmt::format("go on with: burnish run --resume {}", directory.string());
}

RunSummary compute(const Scene& scene, const RunArguments& arguments, const SignalGuard& signals,
                   RunOutputs& outputs) {
  const RunOptions options{.threads = arguments.threads, .halt = [&] { return signals.count() > 0; }};
  try {
    if (arguments.continues && canBeResumed(arguments.directory)) {
      try {
        return resumeRun(scene, arguments.directory, options, outputs);
      } catch (const Error& error) {
        if (outputs.hasStarted()) throw;
        fmt::print(stderr, "burnish: begins anew: {}\n", error.what());
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

ExitCode reportEnd(const RunArguments& arguments, const RunSummary& summary, int signal) {
  for (const std::string& warning : warnings(summary)) fmt::print(stderr, "warning: {}\n", warning);
  if (summary.completed) return ExitCode::Fine;
  if (summary.halted) {
    fmt::print(stderr, "burnish: {} by a signal; nothing is lost; {}\n", summary.stoppedBecause,
               howToResume(arguments.directory));
    return signal == SIGINT ? ExitCode::Interrupted : ExitCode::Terminated;
  }
  fmt::print(stderr, "burnish: the run did not reach its end: {}; the results up to there are kept\n",
             summary.stoppedBecause);
  if (!summary.advice.empty()) fmt::print(stderr, "burnish: what usually helps: {}\n", summary.advice);
  return ExitCode::Stopped;
}

ExitCode run(const RunArguments& arguments) {
  const Scene scene = arguments.resumes ? readResultScene(arguments.directory)
                                        : readScene(arguments.scene, arguments.overrides);
  OffscreenCanvas::saveMemory();  // for the solver
  const SignalGuard signals(SecondSignal::Ends);
  RunOutputs outputs(scene, arguments.directory, !arguments.quiet, !arguments.noDoubts);
  const RunSummary summary = compute(scene, arguments, signals, outputs);
  if (!summary.halted) outputs.finish(!summary.doubts.empty());
  if (!arguments.quiet) printResults(arguments, summary, outputs);
  std::fflush(stdout);
  return reportEnd(arguments, summary, signals.signal());
}

bool isComplete(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / "summary.yaml") && readSummary(directory).completed;
}

ExitCode runOrResume(RunArguments arguments) {
  if (arguments.resumes && isComplete(arguments.directory)) {
    fmt::print("the run in {} has come to its end; there is nothing to resume\n",
               arguments.directory.string());
    return ExitCode::Fine;
  }
  if (!arguments.resumes && arguments.directory.empty())
    arguments.directory = std::filesystem::path("out") / arguments.scene.stem();
  return run(arguments);
}

}  // namespace

void addRunCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Compute a scene; write results, VTU files and pictures");
  const auto arguments = std::make_shared<RunArguments>();
  CLI::Option* scene = command->add_option("SCENE", arguments->scene, "Scene file (YAML)");
  CLI::Option* output =
      command->add_option("-o,--output", arguments->directory,
                          "Directory for everything that is written [out/NAME of the scene]");
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
  command->add_flag("--quiet", arguments->quiet, "Print errors and warnings only");
  command->add_flag("--timings", arguments->timings, "Print where the time went");
  command->add_flag("--no-doubts", arguments->noDoubts,
                    "Do not mark pictures of results that the run doubts");
  command->callback([&action, arguments] {
    if (arguments->scene.empty() && !arguments->resumes) throw CLI::RequiredError("SCENE or --resume DIR");
    action = [arguments] { return runOrResume(*arguments); };
  });
}

}  // namespace burnish
