#include "postproc/compare/annotations.h"

#include <fmt/format.h>
#include <json/value.h>

#include <span>
#include <string_view>
#include <utility>

#include "engine/core/fingerprint.h"
#include "postproc/compare/comparison_json.h"

namespace burnish {
namespace {

/// A text of a workflow command; of a property also without what ends one.
std::string commandText(std::string_view text, bool isProperty) {
  std::string result;
  for (const char letter : text) {
    const bool isEscaped =
        letter == '%' || letter == '\r' || letter == '\n' || (isProperty && (letter == ':' || letter == ','));
    result += isEscaped ? fmt::format("%{:02X}", static_cast<unsigned char>(letter)) : std::string(1, letter);
  }
  return result;
}

}  // namespace

std::string githubAnnotations(const std::vector<ComparedCase>& cases) {
  std::string text;
  for (const ComparedCase& each : cases)
    if (each.outcome != CaseOutcome::Passed)
      text += fmt::format("::error title={}::{}\n", commandText(each.name, true),
                          commandText(each.message, false));
  return text;
}

std::string codeQualityText(const std::vector<ComparedCase>& cases, const std::string& baseline) {
  std::vector<Json::Value> issues;
  for (const ComparedCase& each : cases) {
    if (each.outcome == CaseOutcome::Passed) continue;
    Json::Value issue;
    issue["description"] = each.name + ": " + each.message;
    issue["check_name"] = "burnish compare: " + each.verdict;
    issue["severity"] = each.outcome == CaseOutcome::Failed ? "major" : "critical";
    // Of what failed, not of the numbers, so that it is one issue as long as it fails.
    Fingerprint fingerprint;
    const std::string what = baseline + '\n' + each.name + '\n' + each.verdict;
    fingerprint.add(std::as_bytes(std::span(what)));
    issue["fingerprint"] = fingerprint.text();
    issue["location"]["path"] = baseline;
    issue["location"]["lines"]["begin"] = 1;
    issues.push_back(std::move(issue));
  }
  return listText(issues);
}

}  // namespace burnish
