#include <fmt/format.h>
#include <json/value.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/jobs/child_process.h"
#include "cli/jobs/study_plan.h"
#include "cli/jobs/study_progress.h"
#include "cli/output_lock.h"
#include "engine/core/error.h"
#include "postproc/study/verification/check_table.h"
#include "postproc/study/verification/verification_document.h"
#include "postproc/text/json_text.h"
#include "postproc/text/text_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  std::vector<fs::path> scenes{fs::path("scenes") / "verification"};
  fs::path directory = fs::path("out") / "verification";
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  fs::path document;
  fs::path gallery;
  bool json = false;
};

/// Control nets may lie beside the scenes that name them; only scenes have a geometry or
/// bodies.
bool isScene(const fs::path& file) {
  const std::string text = "\n" + readText(file);
  return text.find("\ngeometry:") != std::string::npos || text.find("\nbodies:") != std::string::npos;
}

/// The scenes of a directory in the order of their names, or the file itself.
std::vector<fs::path> scenesIn(const fs::path& path) {
  std::error_code status;
  if (!fs::is_directory(path, status)) return {path};
  std::vector<fs::path> scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, status))
    if (entry.path().extension() == ".yaml" && isScene(entry.path())) scenes.push_back(entry.path());
  if (status) throw Error(fmt::format("{}: cannot be read: {}", path.string(), status.message()));
  if (scenes.empty()) throw Error(fmt::format("{}: found no scene; expected *.yaml", path.string()));
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// Runs what is missing or out of date; the signal that ended the work, or 0.
int computeRuns(const std::vector<VerificationCase>& cases, const VerifyArguments& arguments) {
  const Study study = studyOf(cases);
  const StudyPlan plan = planStudy(study, arguments.directory, {}, arguments.jobs);
  if (!arguments.json) printOut("runs: {}, of which to compute: {}\n", plan.runs.size(), plan.jobs.size());
  flushOutput();
  prepareJobs(plan, arguments.directory);
  const auto progress = progressOf(plan, !arguments.json);
  return runJobs(plan.jobs, arguments.jobs, *progress).signal;
}

CaseOutcomes outcomesOf(const VerificationCase& verified, const fs::path& directory) {
  CaseOutcomes outcomes;
  for (const CaseFamily& family : verified.families) {
    auto& added = outcomes.emplace_back();
    for (const CaseVariant& variant : family.variants)
      added.push_back(outcomeOf(runDirectory(directory, variant.run)));
  }
  return outcomes;
}

/// Prints a table for each case and a last line for all; whether all checks hold.
bool printVerdicts(const std::vector<VerifiedCase>& cases) {
  std::size_t all = 0, holding = 0;
  for (const auto& [verified, outcomes, judged] : cases) {
    const std::string& title = verified->document.scene.title;
    printOut("\n{}{}\n{}{}{}", verified->name, title.empty() ? "" : ": " + title,
             checkTable(*verified, judged), problemsText(judged), doubtsText(*verified, outcomes));
    all += judged.size();
    holding += numHolding(judged);
  }
  printOut("\n{} of {} checks hold\n", holding, all);
  return holding == all;
}

template <class Numbers>
Json::Value numbersJson(const Numbers& numbers) {
  Json::Value list(Json::arrayValue);
  for (const auto& number : numbers) list.append(number ? Json::Value(*number) : Json::Value());
  return list;
}

/// What is expected, in numbers and in words.
void addExpectation(Json::Value& value, const CheckRow& row) {
  value["expected_text"] = row.expected;
  if (row.relation.empty()) return;  // without values nothing is known of formulas
  value["operator"] = row.relation;
  if (row.bounds.size() == 1) value["expected"] = row.bounds.front();
  if (row.bounds.size() > 1)
    for (const double bound : row.bounds) value["expected"].append(bound);
  if (!row.margin) return;
  value["tolerance"] = *row.margin;
  value["relative"] = row.isShare;
}

Json::Value rowJson(const CheckSpec& check, const CheckRow& row) {
  Json::Value value;
  value["check"] = check.name;
  if (!row.family.empty()) value["family"] = row.family;
  value["verdict"] = verdictText(row.verdict);
  value["values"] = numbersJson(row.values);
  if (!row.orders.empty()) value["orders"] = numbersJson(row.orders);
  addExpectation(value, row);
  if (row.deviation) value["deviation"] = *row.deviation;
  if (!row.problem.empty()) value["problem"] = row.problem;
  return value;
}

/// An object in a line for each case; whether all checks hold.
bool printJson(const std::vector<VerifiedCase>& cases) {
  bool allHold = true;
  for (const VerifiedCase& one : cases) {
    Json::Value value;
    value["case"] = one.verified->name;
    value["title"] = one.verified->document.scene.title;
    value["checks"] = Json::Value(Json::arrayValue);
    for (const JudgedCheck& judged : one.judged)
      for (const CheckRow& row : judged.rows) value["checks"].append(rowJson(*judged.check, row));
    const bool holds = numHolding(one.judged) == one.judged.size();
    value["holds"] = holds;
    allHold = allHold && holds;
    printText(compactText(value, kJsonDigits) + "\n");
  }
  return allHold;
}

ExitCode verify(const VerifyArguments& arguments) {
  requireDirectoryName("-o", arguments.directory);
  requireDocumentName(arguments.document);
  std::vector<VerificationCase> cases;
  for (const fs::path& path : arguments.scenes)
    for (const fs::path& scene : scenesIn(path)) cases.push_back(readCase(scene));
  requireNotInput("--document", arguments.document, arguments.scenes);
  const DirectoryLock lock = lockOutput(arguments.directory);
  const int signal = computeRuns(cases, arguments);
  if (signal != 0) return interrupted(signal);
  std::vector<VerifiedCase> verified;
  for (const VerificationCase& one : cases) {
    CaseOutcomes outcomes = outcomesOf(one, arguments.directory);
    auto judged = judgeChecks(one, outcomes);
    verified.push_back({&one, std::move(outcomes), std::move(judged)});
  }
  const bool allHold = arguments.json ? printJson(verified) : printVerdicts(verified);
  if (!arguments.document.empty()) {
    const SignalGuard signals(SecondSignal::Ends);
    const fs::path pictures = arguments.gallery.empty()
                                  ? arguments.document.parent_path() / "images" / arguments.document.stem()
                                  : arguments.gallery;
    writeVerification(verified, arguments.document, pictures);
    if (!arguments.json) printOut("document {}\n", arguments.document.string());
  }
  return allHold ? ExitCode::Fine : ExitCode::ChecksFail;
}

}  // namespace

void addVerifyCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("verify", "Compute scenes and check what they must produce");
  const auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("SCENE", arguments->scenes, "Scene files (YAML) or directories [scenes/verification]");
  command->add_option("-o,--output", arguments->directory, "Directory for all results [out/verification]")
      ->type_name("DIR");
  command->add_option("--jobs", arguments->jobs, "Runs at a time [one per processor]")
      ->check(CLI::Range(1, 1024));
  command->add_option("--document", arguments->document, "Write a document with tables and charts")
      ->type_name("FILE.md");
  command
      ->add_option("--gallery", arguments->gallery,
                   "Directory of the document's charts [images/NAME of the document, beside it]")
      ->type_name("DIR");
  command->add_flag("--json", arguments->json,
                    "Print a JSON object in a line for each scene instead of tables");
  command->callback([&action, arguments] { action = [arguments] { return verify(*arguments); }; });
}

}  // namespace burnish
