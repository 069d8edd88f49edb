#include <fmt/format.h>
#include <json/value.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "cli/jobs/snakefile.h"
#include "cli/jobs/study_plan.h"
#include "cli/jobs/study_progress.h"
#include "cli/jobs/study_table.h"
#include "cli/late_vtk.h"
#include "cli/offered_words.h"
#include "cli/output_lock.h"
#include "engine/core/atomic_file.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/document.h"
#include "postproc/study/study_reader.h"
#include "postproc/text/json_text.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

constexpr std::array kWorkflows{std::pair{"snakemake", "Snakefile"}};  ///< with the names of their files

struct FiguresArguments {
  fs::path study;
  fs::path output;  ///< the directory, or the file of a workflow
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::string> only;
  fs::path document;
  fs::path gallery;
  std::optional<std::string> workflow;
  fs::path results;  ///< of a workflow
  bool json = false;
  bool drawOnly = false;  ///< in a process that another one has started
};

ExitCode draw(const Study& study, const FiguresArguments& arguments) {
  const SignalGuard signals(SecondSignal::Ends);
  for (const std::string& name : arguments.only)
    drawAndRecord(study, findFigure(study, name), arguments.output);
  return ExitCode::Fine;
}

void announce(const StudyPlan& plan) {
  const auto isDue = [](const auto& item) { return item.job.has_value(); };
  printOut("runs: {}, of which to compute: {}; figures: {}, of which to draw: {}\n", plan.runs.size(),
           std::count_if(plan.runs.begin(), plan.runs.end(), isDue), plan.figures.size(),
           std::count_if(plan.figures.begin(), plan.figures.end(), isDue));
  flushOutput();
}

/// Wall-clock seconds until the last run had ended, and from then on.
void printTimes(const StudyPlan& plan, const std::vector<JobStatus>& jobs) {
  double runs = 0.0, all = 0.0;
  for (const PlannedRun& run : plan.runs)
    if (run.job) runs = std::max(runs, jobs[*run.job].end);
  for (const JobStatus& job : jobs) all = std::max(all, job.end);
  printOut("wall-clock time: {:.1f} s for the runs, {:.1f} s more for the figures\n", runs, all - runs);
}

void printResults(const StudyPlan& plan, const std::vector<JobStatus>& jobs, const fs::path& directory) {
  printOut("\n{}\n", runsTable(plan, jobs));
  for (const PlannedFigure& figure : plan.figures) {
    const std::vector<fs::path> files = drawnFiles(directory, figure.figure->name);
    const std::string more = files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "";
    printOut("figure {}: {}{}\n", figure.figure->name, files.empty() ? "missing" : files.front().string(),
             more);
  }
  printTimes(plan, jobs);
  flushOutput();
}

void printResultsJson(const StudyPlan& plan, const std::vector<JobStatus>& jobs,
                      const FiguresArguments& arguments) {
  Json::Value value;
  value["runs"] = runsJson(plan, jobs);
  value["figures"] = Json::Value(Json::arrayValue);
  for (const PlannedFigure& figure : plan.figures) {
    Json::Value& added = value["figures"].append(Json::Value());
    added["name"] = figure.figure->name;
    added["files"] = Json::Value(Json::arrayValue);
    for (const fs::path& file : drawnFiles(arguments.output, figure.figure->name))
      added["files"].append(file.string());
  }
  if (arguments.only.empty()) value["document"] = arguments.document.string();
  printText(compactText(value, kJsonDigits) + "\n");
}

ExitCode makeEverything(const Study& study, const FiguresArguments& arguments) {
  const DirectoryLock lock = lockOutput(arguments.output);
  loadVtk();  // what would fail when figures are drawn fails before anything is computed
  const StudyPlan plan = planStudy(study, arguments.output, arguments.only, arguments.jobs);
  requireOutlooks(study, plan);
  if (!arguments.json) announce(plan);
  prepareJobs(plan, arguments.output);
  PoolResult result;
  {
    const auto progress = progressOf(plan, !arguments.json);
    result = runJobs(plan.jobs, arguments.jobs, *progress);
  }
  if (result.signal != 0) return interrupted(result.signal);
  if (!arguments.json) printResults(plan, result.jobs, arguments.output);
  std::vector<std::string> faults;  // of the study's measures
  if (arguments.only.empty()) {
    const std::string csv = runsCsv(plan, result.jobs);
    writeFileAtomically(arguments.output / "runs.csv", std::as_bytes(std::span(csv)));
    faults =
        writeDocument(study, arguments.output, {.file = arguments.document, .gallery = arguments.gallery});
    if (!arguments.json) printOut("document {}\n", arguments.document.string());
  }
  if (arguments.json) printResultsJson(plan, result.jobs, arguments);
  const bool allFine = std::all_of(result.jobs.begin(), result.jobs.end(),
                                   [](const JobStatus& job) { return job.state == JobState::Fine; });
  for (const std::string& fault : faults) printError("burnish: {}\n", fault);
  return allFine && faults.empty() ? ExitCode::Fine : ExitCode::Incomplete;
}

/// file: as it is called if no other name is given.
ExitCode writeWorkflow(const FiguresArguments& arguments, const char* file) {
  const SnakefileOptions options{.file = arguments.output.empty() ? file : arguments.output,
                                 .results = arguments.results,
                                 .document = arguments.document,
                                 .gallery = arguments.gallery};
  requireNotInput("--document", options.document, {arguments.study, options.file});
  const Study study = readStudy(arguments.study);
  std::vector<RunOutlook> outlooks;
  for (const StudyRun& run : study.runs)
    outlooks.push_back(outlookBefore(readSceneDocument(run.scene, run.overrides).scene));
  requireOutlooks(study, outlooks);
  writeSnakefile(study, options);
  printOut("workflow {}: {} runs, {} figures and a document; start it with: {} -c2\n", options.file.string(),
           study.runs.size(), study.spec.figures.size(), snakemakeCommand(options.file));
  flushOutput();
  return ExitCode::Fine;
}

ExitCode figures(FiguresArguments arguments) {
  requireDocumentName(arguments.document);
  if (arguments.workflow)
    return writeWorkflow(arguments, chosen("--workflow", *arguments.workflow, kWorkflows));
  requireDirectoryName("-o", arguments.output);
  const Study study = readStudy(arguments.study);
  if (arguments.output.empty()) arguments.output = fs::path("out") / arguments.study.stem();
  if (arguments.document.empty())
    arguments.document = arguments.output / arguments.study.stem().concat(".md");
  requireNotInput("--document", arguments.document, {arguments.study});
  return arguments.drawOnly ? draw(study, arguments) : makeEverything(study, arguments);
}

}  // namespace

void addFiguresCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("figures", "Compute the runs of a study and draw its figures");
  const auto arguments = std::make_shared<FiguresArguments>();
  command->add_option("STUDY", arguments->study, "Study file (YAML)")->required();
  command->footer(
      "With --workflow nothing is computed: a file is written in which every run, every figure and the document\n"
      "are rules that call burnish, for a program that works them off here or on a cluster. snakemake -c2 has two\n"
      "at a time here; docs/study.md shows how Slurm is asked.");
  command
      ->add_option("-o,--output", arguments->output,
                   "Directory for everything that is written [out/NAME of the study]; with --workflow its "
                   "file [Snakefile]")
      ->type_name("DIR");
  CLI::Option* jobs =
      command->add_option("--jobs", arguments->jobs, "Runs or figures at a time [one per processor]")
          ->check(CLI::Range(1, 1024));
  CLI::Option* only = command
                          ->add_option("--only", arguments->only,
                                       "Draw only this figure, from the runs that it needs; may be repeated")
                          ->type_name("FIGURE")
                          ->allow_extra_args(false);
  CLI::Option* json = command->add_flag("--json", arguments->json,
                                        "Print what became of runs and figures as one JSON object");
  command->add_option("--document", arguments->document, "Name of the document [NAME of the study.md in DIR]")
      ->type_name("FILE.md");
  command
      ->add_option("--gallery", arguments->gallery, "Directory to which the document's pictures are copied")
      ->type_name("DIR");
  CLI::Option* drawOnly = command->add_flag("--draw-only", arguments->drawOnly)->group("");
  CLI::Option* workflow =
      command
          ->add_option("--workflow", arguments->workflow, "Write the study as a workflow instead: snakemake")
          ->type_name("KIND")
          ->excludes(jobs)
          ->excludes(only)
          ->excludes(drawOnly)
          ->excludes(json);
  offerChoices(*workflow, kWorkflows);
  command
      ->add_option("--results", arguments->results,
                   "Directory for everything that the workflow makes [out/NAME of the study]")
      ->type_name("DIR")
      ->needs(workflow);
  command->callback([&action, arguments] { action = [arguments] { return figures(*arguments); }; });
}

}  // namespace burnish
