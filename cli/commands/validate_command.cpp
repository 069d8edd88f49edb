#include <fmt/format.h>
#include <fmt/ranges.h>
#include <json/value.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/commands/document_places_check.h"
#include "cli/commands/info_json.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "engine/analysis/scene_report.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/error.h"
#include "engine/schema/diagnostics.h"
#include "postproc/study/study_reader.h"
#include "postproc/text/json_text.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct ValidateArguments {
  std::vector<fs::path> files;
  std::vector<std::string> overrides;
  bool json = false;
};

/// Only studies have runs.
bool isStudy(const fs::path& file) {
  std::error_code status;
  return fs::is_regular_file(file, status) && ("\n" + readText(file)).find("\nruns:") != std::string::npos;
}

std::string bytesText(double bytes) {
  return bytes < 0.95e9 ? fmt::format("{:.0f} MB", 1e-6 * bytes) : fmt::format("{:.1f} GB", 1e-9 * bytes);
}

std::string secondsText(double seconds) {
  return seconds < 0.01   ? fmt::format("{:.1f} ms", 1e3 * seconds)
         : seconds < 0.95 ? fmt::format("{:.0f} ms", 1e3 * seconds)
         : seconds < 10.0 ? fmt::format("{:.1f} s", seconds)
         : seconds < 60.0 ? fmt::format("{:.0f} s", seconds)
                          : durationText(seconds);
}

/// What a run will take.
std::string costText(const CostEstimate& cost) {
  return fmt::format(
      "takes about {}, and on one core {} per Newton iteration (assembly {}, contact {}, linear systems {}); "
      "{} steps of some {} iterations: {}",
      bytesText(cost.bytes), secondsText(cost.perIteration()), secondsText(cost.assembly),
      secondsText(cost.contact), secondsText(cost.linearSystems), cost.steps, cost.iterationsPerStep,
      secondsText(cost.seconds()));
}

/// A scene that can be computed, every default filled in, and what is said of it and of its results.
struct GoodScene {
  std::string resolvedYaml;
  SceneReport report;
  RunOutlook outlook;
};

/// Warnings begin with who has them.
GoodScene validateScene(const fs::path& file, const std::vector<std::string>& overrides,
                        const std::string& who) {
  const SceneDocument document = readSceneInput(file, overrides);
  SceneReport report = reportOf(document.scene);
  requirePlaces(document, report.model);
  for (const std::string& warning : report.warnings) printError("warning: {}{}\n", who, warning);
  RunOutlook outlook = outlookOf(document.scene);
  outlook.frameTimes = frameTimes(document.scene);
  outlook.columns = report.columns;
  return {document.scene.resolvedYaml, std::move(report), std::move(outlook)};
}

/// A file that was looked at, in words and as JSON.
struct Validated {
  std::string text;
  Json::Value json;
};

Json::Value costJson(double bytes, double seconds) {
  Json::Value value;
  value["bytes"] = bytes;
  value["seconds"] = seconds;
  return value;
}

Validated sceneVerdict(const GoodScene& scene) {
  const SceneReport& report = scene.report;
  Json::Value json = costJson(report.cost.bytes, report.cost.seconds());
  json["summary"] = report.summary;
  json["steps"] = report.cost.steps;
  Diagnostics none("", {});
  json["scene"] = documentJson(parseYaml(scene.resolvedYaml, 0, none).value());
  json["yaml"] = scene.resolvedYaml;
  json["warnings"] = Json::Value(Json::arrayValue);
  for (const std::string& warning : report.warnings) json["warnings"].append(warning);
  return {fmt::format("fine ({})\n  {}", report.summary, costText(report.cost)), json};
}

/// The same of a study: builds the models of all its runs, and throws `Error` with the faults of all.
Validated validateStudy(const fs::path& file, const std::vector<std::string>& overrides) {
  if (!overrides.empty())
    throw Error(fmt::format("{}: --set changes scenes, and this is a study; leave it out", file.string()));
  const Study study = readStudy(file);
  std::vector<std::string> faults;
  std::vector<RunOutlook> outlooks(study.runs.size());
  double bytes = 0.0, seconds = 0.0;
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const StudyRun& run = study.runs[k];
    const std::string who = fmt::format("{}: run \"{}\": ", file.string(), run.name);
    try {
      GoodScene good = validateScene(run.scene, run.overrides, who);
      outlooks[k] = std::move(good.outlook);
      const CostEstimate& cost = good.report.cost;
      bytes = std::max(bytes, cost.bytes);
      seconds += cost.seconds();
    } catch (const Error& error) {
      faults.push_back(who + error.what());
    }
  }
  try {
    requireOutlooks(study, outlooks);
  } catch (const Error& error) {
    faults.emplace_back(error.what());
  }
  if (!faults.empty()) throw Error(fmt::format("{}", fmt::join(faults, "\n")));
  Json::Value json = costJson(bytes, seconds);
  json["runs"] = static_cast<Json::UInt64>(study.runs.size());
  json["figures"] = static_cast<Json::UInt64>(study.spec.figures.size());
  return {
      fmt::format(
          "fine (a study of {} runs and {} figures)\n  its runs take about {} on one core, and {} each at most",
          study.runs.size(), study.spec.figures.size(), secondsText(seconds), bytesText(bytes)),
      json};
}

Json::Value problemsJson(const std::string& text) {
  Json::Value json;
  json["problems"] = Json::Value(Json::arrayValue);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) json["problems"].append(line);
  return json;
}

void printVerdict(const fs::path& file, bool isFine, Json::Value json) {
  json["file"] = file.string();
  json["fine"] = isFine;
  printText(compactText(json, kJsonDigits) + "\n");
}

ExitCode validate(const ValidateArguments& arguments) {
  bool allAreGood = true;
  for (const fs::path& file : arguments.files) {
    try {
      Validated good = isStudy(file) ? validateStudy(file, arguments.overrides)
                                     : sceneVerdict(validateScene(file, arguments.overrides, ""));
      if (arguments.json)
        printVerdict(file, true, std::move(good.json));
      else
        printOut("{}: {}\n", file.string(), good.text);
    } catch (const Error& error) {
      if (arguments.json) printVerdict(file, false, problemsJson(error.what()));
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
  command
      ->add_option("SCENE", arguments->files, "Scene or study files (YAML); - for a scene on standard input")
      ->required();
  command
      ->add_option("--set", arguments->overrides,
                   "path=value: change an entry of every scene, e.g. --set degree=3; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command->add_flag(
      "--json", arguments->json,
      "Print a JSON object in a line for each file; of a good scene also all of it, every default filled in");
  command->callback([&action, arguments] { action = [arguments] { return validate(*arguments); }; });
}

}  // namespace burnish
