#include <fmt/format.h>
#include <json/value.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/doctor/examination.h"
#include "postproc/text/json_text.h"

namespace burnish {
namespace {

/// As wide as its column, whatever its colour.
std::string stateText(const Finding& finding) {
  const std::string word = finding.isThere ? "ok" : "missing";
  const Tone tone = finding.isThere ? Tone::Good : finding.needed.empty() ? Tone::Bad : Tone::Doubtful;
  return toned(tone, word) + std::string(9 - word.size(), ' ');
}

std::string findingText(const Finding& finding) {
  std::string text = stateText(finding) + fmt::format("{:<11}{}\n", finding.name, finding.what);
  if (finding.isThere) return text;
  if (!finding.needed.empty()) text += fmt::format("{:20}needed for {}\n", "", finding.needed);
  return text + fmt::format("{:20}{}\n", "", finding.remedy);
}

Json::Value findingJson(const Finding& finding) {
  Json::Value value;
  value["name"] = finding.name;
  value["ok"] = finding.isThere;
  value["required"] = finding.needed.empty();
  value["found"] = finding.what;
  if (!finding.needed.empty()) value["needed_for"] = finding.needed;
  if (!finding.isThere) value["remedy"] = finding.remedy;
  return value;
}

ExitCode doctor(bool json) {
  const std::vector<Finding> findings = examine();
  const auto isMissing = [](const Finding& finding) { return !finding.isThere; };
  const auto isNeeded = [](const Finding& finding) { return !finding.isThere && finding.needed.empty(); };
  if (json) {
    Json::Value list(Json::arrayValue);
    for (const Finding& finding : findings) list.append(findingJson(finding));
    printText(compactText(list) + "\n");
  } else {
    for (const Finding& finding : findings) printText(findingText(finding));
    const auto missing = std::ranges::count_if(findings, isMissing),
               needed = std::ranges::count_if(findings, isNeeded);
    printText(missing == 0  ? "all is there\n"
              : needed == 0 ? "all is there that every run and picture needs\n"
                            : "runs or pictures will fail until what is missing is there\n");
  }
  return std::ranges::none_of(findings, isNeeded) ? ExitCode::Fine : ExitCode::ChecksFail;
}

}  // namespace

void addDoctorCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Tell what is there of all that the program uses, and what to do about the rest");
  command->footer(
      "Exit codes: 0 all is there that every run and picture needs, 1 something of it is missing.");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print a list of one JSON object for each");
  command->callback([&action, json] { action = [json] { return doctor(*json); }; });
}

}  // namespace burnish
