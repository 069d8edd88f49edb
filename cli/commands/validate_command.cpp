#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/commands/picture_planes_check.h"
#include "cli/console.h"
#include "engine/analysis/scene_report.h"
#include "engine/core/error.h"
#include "postproc/scene/scene_document.h"
#include "postproc/study/study_reader.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
  std::vector<fs::path> files;
  std::vector<std::string> overrides;
};

/// Only studies have runs.
bool isStudy(const fs::path& file) {
  std::error_code status;
  return fs::is_regular_file(file, status) && ("\n" + readText(file)).find("\nruns:") != std::string::npos;
}

/// What is said of a good scene. Warnings begin with who has them.
std::string validateScene(const fs::path& file, const std::vector<std::string>& overrides,
                          const std::string& who) {
  const SceneDocument document = readSceneDocument(file, overrides);
  const SceneReport report = reportOf(document.scene);
  requirePlanes(document, report.model);
  for (const std::string& warning : report.warnings) printError("warning: {}{}\n", who, warning);
  return report.summary;
}

/// The same of a study: builds the models of all its runs, and throws `Error` with the faults of all.
std::string validateStudy(const fs::path& file, const std::vector<std::string>& overrides) {
  if (!overrides.empty())
    throw Error(fmt::format("{}: --set changes scenes, and this is a study; leave it out", file.string()));
  const Study study = readStudy(file);
  std::vector<std::string> faults;
  for (const StudyRun& run : study.runs) {
    const std::string who = fmt::format("{}: run \"{}\": ", file.string(), run.name);
    try {
      validateScene(run.scene, run.overrides, who);
    } catch (const Error& error) {
      faults.push_back(who + error.what());
    }
  }
  if (!faults.empty()) throw Error(fmt::format("{}", fmt::join(faults, "\n")));
  return fmt::format("a study of {} runs and {} figures", study.runs.size(), study.spec.figures.size());
}

ExitCode validate(const ValidateArguments& arguments) {
  bool allAreGood = true;
  for (const fs::path& file : arguments.files) {
    try {
      const std::string summary = isStudy(file) ? validateStudy(file, arguments.overrides)
                                                : validateScene(file, arguments.overrides, "");
      printOut("{}: fine ({})\n", file.string(), summary);
    } catch (const Error& error) {
      printError("{}\n", error.what());
      allAreGood = false;
    }
    flushOutput();
  }
  return allAreGood ? ExitCode::Fine : ExitCode::BadInput;
}

}  // namespace

void addValidateCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "validate", "Check scenes and studies, and whether they can be computed, without computing them");
  const auto arguments = std::make_shared<ValidateArguments>();
  command->add_option("SCENE", arguments->files, "Scene or study files (YAML)")->required();
  command
      ->add_option("--set", arguments->overrides,
                   "path=value: change an entry of every scene, e.g. --set degree=3; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command->callback([&action, arguments] { action = [arguments] { return validate(*arguments); }; });
}

}  // namespace burnish
