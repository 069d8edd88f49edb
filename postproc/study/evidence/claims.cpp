#include "postproc/study/evidence/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/study/combinations.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

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

Verdict opposite(Verdict verdict) {
  if (verdict == Verdict::CannotBeTold) return verdict;
  return verdict == Verdict::Holds ? Verdict::DoesNotHold : Verdict::Holds;
}

Verdict verdictOn(const ClaimSpec& claim, const std::vector<ClaimedValue>& values) {
  switch (claim.expect) {
    case Expectation::Increasing:
      return judgeIncreasing(values);
    case Expectation::Equal:
      return judgeEqual(values, claim.within.value());
    case Expectation::Different:
      return opposite(judgeEqual(values, claim.within.value()));
    case Expectation::Between:
      return judgeBetween(values, claim.range.value());
  }
  return Verdict::CannotBeTold;
}

JudgedClaim judge(const Study& study, const MeasureSpec& measure, const ClaimSpec& claim,
                  const std::map<std::string, std::string>& parameters,
                  const std::filesystem::path& studyDirectory) {
  std::vector<ClaimedValue> values;
  for (const std::string& name : claim.runs) {
    const StudyRun& run = runNamed(study, fillIn(name, parameters));
    values.push_back({run.label, evaluateMeasure(study, run, measure, studyDirectory)});
  }
  return {fillIn(claim.text, parameters), verdictOn(claim, values),
          fmt::format("{} — {}", measure.title, numbersText(values))};
}

bool allKnown(const std::vector<ClaimedValue>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const ClaimedValue& value) { return value.measured.comparable().has_value(); });
}

std::vector<double> knownOf(const std::vector<ClaimedValue>& values) {
  std::vector<double> known;
  for (const ClaimedValue& value : values)
    if (const auto v = value.measured.comparable()) known.push_back(*v);
  return known;
}

}  // namespace

std::string verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::Holds:
      return "holds";
    case Verdict::DoesNotHold:
      return "does not hold";
    case Verdict::CannotBeTold:
      break;
  }
  return "cannot be told";
}

Verdict judgeIncreasing(const std::vector<ClaimedValue>& values) {
  const std::vector<double> known = knownOf(values);
  const auto falling =
      std::adjacent_find(known.begin(), known.end(), [](double a, double b) { return !(a < b); });
  if (falling != known.end()) return Verdict::DoesNotHold;
  return allKnown(values) ? Verdict::Holds : Verdict::CannotBeTold;
}

Verdict judgeEqual(const std::vector<ClaimedValue>& values, double within) {
  // A missing value could be the largest, so values that disagree prove nothing before all are known.
  if (values.empty() || !allKnown(values)) return Verdict::CannotBeTold;
  const std::vector<double> known = knownOf(values);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  return *high - *low <= within * largest ? Verdict::Holds : Verdict::DoesNotHold;
}

Verdict judgeBetween(const std::vector<ClaimedValue>& values, const std::array<double, 2>& range) {
  const std::vector<double> known = knownOf(values);
  if (std::any_of(known.begin(), known.end(), [&](double v) { return !(v >= range[0] && v <= range[1]); }))
    return Verdict::DoesNotHold;
  return allKnown(values) ? Verdict::Holds : Verdict::CannotBeTold;
}

std::vector<JudgedClaim> judgeClaims(const Study& study, const StatementSpec& statement,
                                     const std::filesystem::path& studyDirectory) {
  std::vector<JudgedClaim> judged;
  for (const ClaimSpec& claim : statement.claims) {
    const MeasureSpec& measure = measureNamed(statement, claim.measure);
    for (const auto& parameters : combinations(claim.vary))
      judged.push_back(judge(study, measure, claim, parameters, studyDirectory));
  }
  return judged;
}

}  // namespace burnish
