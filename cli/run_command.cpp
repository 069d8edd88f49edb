#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/run_outputs.h"
#include "cli/summary_text.h"
#include "engine/scene/reader.h"
#include "postproc/offscreen/offscreen_canvas.h"

namespace burnish {
namespace {

struct RunArguments {
  std::filesystem::path scene;
  std::filesystem::path directory;
  std::vector<std::string> overrides;
  int threads = 0;
  bool quiet = false;
  bool timings = false;
};

void printResults(const RunArguments& arguments, const RunSummary& summary, const RunOutputs& outputs) {
  fmt::print("{}", summaryText(summary));
  if (arguments.timings) fmt::print("{}", timingsText(summary));
  fmt::print("results in {}\n", arguments.directory.string());
  for (const auto& picture : outputs.pictures()) fmt::print("  picture {}\n", picture.string());
}

ExitCode run(RunArguments arguments) {
  if (arguments.directory.empty())
    arguments.directory = std::filesystem::path("out") / arguments.scene.stem();
  const Scene scene = readScene(arguments.scene, arguments.overrides);
  OffscreenCanvas::saveMemory();  // for the solver
  RunOutputs outputs(scene, arguments.directory, !arguments.quiet);
  const RunSummary summary = runScene(scene, arguments.directory, {.threads = arguments.threads}, outputs);
  outputs.finish();
  if (!arguments.quiet) printResults(arguments, summary, outputs);
  std::fflush(stdout);
  for (const std::string& warning : warnings(summary)) fmt::print(stderr, "warning: {}\n", warning);
  if (summary.completed) return ExitCode::Fine;
  fmt::print(stderr, "burnish: the run did not reach its end: {}; the results up to there are kept\n",
             summary.stoppedBecause);
  return ExitCode::Stopped;
}

}  // namespace

void addRunCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Compute a scene; write results, VTU files and pictures");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("SCENE", arguments->scene, "Scene file (YAML)")->required();
  command->add_option("-o,--output", arguments->directory,
                      "Directory for everything that is written [out/NAME of the scene]");
  command
      ->add_option("--set", arguments->overrides,
                   "path=value: change an entry of the scene, e.g. --set degree=3; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command->add_option("--threads", arguments->threads, "Number of threads; results do not depend on it [all]")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", arguments->quiet, "Print errors and warnings only");
  command->add_flag("--timings", arguments->timings, "Print where the time went");
  command->callback([&action, arguments] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace burnish
