#include "postproc/study/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/core/error.h"
#include "postproc/study/combinations.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

/// A run's name in a text and what its measure came to.
struct ClaimedValue {
  std::string run;
  Measured measured;
};

/// Enough digits to tell values apart that are no more than rounding apart, so that "1 < 1" is never printed.
int digitsToTellApart(const std::vector<ClaimedValue>& values) {
  constexpr int kFewest = 4, kMost = 12;
  for (int digits = kFewest; digits < kMost; ++digits) {
    std::vector<std::pair<double, std::string>> texts;
    for (const ClaimedValue& value : values)
      if (const auto v = value.measured.comparable()) texts.emplace_back(*v, numberText(*v, digits));
    const bool apart = std::all_of(texts.begin(), texts.end(), [&](const auto& a) {
      return std::all_of(texts.begin(), texts.end(),
                         [&](const auto& b) { return (a.first == b.first) == (a.second == b.second); });
    });
    if (apart) return digits;
  }
  return kMost;
}

std::string numbersText(const std::vector<ClaimedValue>& values) {
  const int digits = digitsToTellApart(values);
  std::vector<std::string> parts;
  for (const auto& [run, measured] : values) {
    const std::string number = measured.value ? numberText(*measured.value, digits) : "—";
    parts.push_back(measured.note.empty() ? fmt::format("{}: {}", run, number)
                                          : fmt::format("{}: {}, {}", run, number, measured.note));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

const MeasureSpec& measureNamed(const StatementSpec& statement, const std::string& name) {
  for (const MeasureSpec& measure : statement.measures)
    if (measure.name == name) return measure;
  throw Error(fmt::format("statement {}: there is no measure \"{}\"", statement.name, name));
}

JudgedClaim judgeClaim(const Study& study, const StatementSpec& statement, const ClaimSpec& claim,
                       const std::map<std::string, std::string>& parameters,
                       const std::filesystem::path& studyDirectory, SeenProfiles& seen,
                       std::vector<std::string>& faults) {
  const MeasureSpec& measure = measureNamed(statement, claim.measure);
  std::vector<ClaimedValue> values;
  std::vector<Observed> numbers;
  for (const std::string& name : claim.runs) {
    const StudyRun& run = runNamed(study, fillIn(name, parameters));
    values.push_back(
        {run.label, measuredOrFault(study, statement, run, measure, studyDirectory, seen, faults)});
    numbers.push_back({.value = values.back().measured.comparable()});
  }
  return {fillIn(claim.text, parameters), judge(claim.expectation(), numbers).verdict,
          fmt::format("{} — {}", measure.title, numbersText(values))};
}

}  // namespace

std::vector<JudgedClaim> judgeClaims(const Study& study, const StatementSpec& statement,
                                     const std::filesystem::path& studyDirectory, SeenProfiles& seen,
                                     std::vector<std::string>& faults) {
  std::vector<JudgedClaim> judged;
  for (const ClaimSpec& claim : statement.claims)
    for (const auto& parameters : combinations(claim.vary))
      judged.push_back(judgeClaim(study, statement, claim, parameters, studyDirectory, seen, faults));
  return judged;
}

}  // namespace burnish
