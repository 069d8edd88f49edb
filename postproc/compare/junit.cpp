#include "postproc/compare/junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "postproc/text/page.h"

namespace burnish {
namespace {

/// A text as the value of an attribute; letters that XML does not know become blanks.
std::string attributeText(std::string text) {
  std::ranges::replace_if(
      text, [](char letter) { return static_cast<unsigned char>(letter) < ' '; }, ' ');
  return escaped(text);
}

std::string caseText(const std::string& suite, const ComparedCase& each) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", attributeText(suite),
                                       attributeText(each.name));
  if (each.outcome == CaseOutcome::Passed) return head + "/>\n";
  return fmt::format("{}>\n      <{} type=\"{}\" message=\"{}\"/>\n    </testcase>\n", head,
                     each.outcome == CaseOutcome::Failed ? "failure" : "error", attributeText(each.verdict),
                     attributeText(each.message));
}

}  // namespace

std::string junitText(const std::string& suite, const std::vector<ComparedCase>& cases) {
  const auto failures = std::ranges::count(cases, CaseOutcome::Failed, &ComparedCase::outcome);
  const auto errors = std::ranges::count(cases, CaseOutcome::Error, &ComparedCase::outcome);
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", cases.size(), failures, errors);
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n  <testsuite name=\"{}\" {}>\n", counts,
      attributeText(suite), counts);
  for (const ComparedCase& each : cases) text += caseText(suite, each);
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace burnish
