#include "postproc/study/evidence/expectation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "postproc/study/evidence/refinement.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

constexpr int kDigits = 4;

using Numbers = std::vector<Observed>;

bool allKnown(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](const Observed& number) { return number.value.has_value(); });
}

std::vector<double> knownOf(const Numbers& numbers) {
  std::vector<double> known;
  for (const Observed& number : numbers)
    if (number.value) known.push_back(*number.value);
  return known;
}

double constant(const FormulaText& formula, const Observed& number) {
  return Formula(formula, number.definitions != nullptr ? *number.definitions : std::vector<DefinitionSpec>())
      .constant();
}

/// An expectation of every single number: one that contradicts it settles the matter.
Verdict verdictOfEach(bool contradicted, const Numbers& numbers) {
  if (contradicted) return Verdict::DoesNotHold;
  return allKnown(numbers) ? Verdict::Holds : Verdict::CannotBeTold;
}

/// The order between the two finest meshes whose errors are above the floor.
std::optional<double> judgedOrder(const std::vector<MeshValue>& errors, double floor) {
  std::vector<MeshValue> known;
  std::copy_if(errors.begin(), errors.end(), std::back_inserter(known),
               [&](const MeshValue& error) { return error.value > floor; });
  if (known.size() < 2) return {};
  return observedOrder(known[known.size() - 2], known.back(), 0.0);
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

Judgement judge(const ExpectedValue& expect, const Numbers& numbers) {
  Judgement result;
  const double tolerance = expect.relative ? *expect.relative : expect.absolute.value();
  double largest = 0.0;
  for (const Observed& number : numbers) {
    if (!number.value) continue;
    const double expected = constant(expect.value, number);
    const double difference = std::abs(*number.value - expected);
    largest = std::max(largest, expect.relative ? difference / std::abs(expected) : difference);
  }
  result.relation = "=";
  result.bounds = {constant(expect.value, numbers.back())};
  result.margin = tolerance;
  result.expected = numberText(result.bounds.front(), kDigits);
  result.isShare = expect.relative.has_value();
  result.tolerance = numberText(result.isShare ? 100.0 * tolerance : tolerance, 2);
  result.deviation = largest;
  result.verdict = verdictOfEach(!(largest <= tolerance), numbers);
  return result;
}

Judgement judge(const ExpectedRange& expect, const Numbers& numbers) {
  const auto isOutside = [&](const Observed& number) {
    return number.value && !((!expect.atLeast || *number.value >= constant(*expect.atLeast, number)) &&
                             (!expect.atMost || *number.value <= constant(*expect.atMost, number)));
  };
  Judgement result;
  result.verdict = verdictOfEach(std::any_of(numbers.begin(), numbers.end(), isOutside), numbers);
  result.relation = !expect.atMost ? ">=" : !expect.atLeast ? "<=" : "in";
  const auto bound = [&](const std::optional<FormulaText>& text) {
    if (!text) return std::string();
    result.bounds.push_back(constant(*text, numbers.back()));
    return numberText(result.bounds.back(), kDigits);
  };
  const std::string from = bound(expect.atLeast), to = bound(expect.atMost);
  result.expected = !expect.atMost    ? "≥ " + from
                    : !expect.atLeast ? "≤ " + to
                                      : fmt::format("{} to {}", from, to);
  return result;
}

Judgement judge(const ExpectedOrder& expect, const Numbers& numbers) {
  Judgement result;
  result.relation = "order";
  result.bounds = {expect.order};
  result.margin = expect.tolerance;
  result.expected = fmt::format("order {:.2f}", expect.order);
  result.tolerance = fmt::format("−{:.2f}", expect.tolerance);
  if (!allKnown(numbers)) return result;
  std::vector<MeshValue> errors;
  for (const Observed& number : numbers) {
    const double limit = expect.limit ? constant(*expect.limit, number) : 0.0;
    errors.push_back({number.size, std::abs(*number.value - limit)});
    result.errors.emplace_back(errors.back().value);
    if (errors.size() > 1)
      result.orders.push_back(observedOrder(errors[errors.size() - 2], errors.back(), 0.0));
  }
  if (const auto order = judgedOrder(errors, expect.floor))
    result.verdict = *order >= expect.order - expect.tolerance ? Verdict::Holds : Verdict::DoesNotHold;
  else
    result.problem = fmt::format("fewer than two meshes have errors above {:.2g}", expect.floor);
  return result;
}

Judgement judge(const ExpectedTrend& expect, const Numbers& numbers) {
  const bool increasing = expect.direction == ExpectedTrend::Direction::Increasing;
  const std::vector<double> known = knownOf(numbers);
  const auto turned = std::adjacent_find(
      known.begin(), known.end(), [&](double a, double b) { return increasing ? !(a < b) : !(a > b); });
  Judgement result;
  result.verdict = verdictOfEach(turned != known.end(), numbers);
  result.expected = result.relation = increasing ? "increasing" : "decreasing";
  return result;
}

Judgement judge(const ExpectedSameness& expect, const Numbers& numbers) {
  Judgement result;
  result.relation = "same";
  result.margin = expect.relative;
  result.expected = "the same";
  result.isShare = true;
  result.tolerance = numberText(100.0 * expect.relative, 2);
  // A missing value could be the largest, so values that disagree prove nothing before all are known.
  if (numbers.empty() || !allKnown(numbers)) return result;
  const std::vector<double> known = knownOf(numbers);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  result.deviation = largest > 0.0 ? (*high - *low) / largest : 0.0;
  result.verdict = *high - *low <= expect.relative * largest ? Verdict::Holds : Verdict::DoesNotHold;
  return result;
}

Judgement judge(const ExpectedDifference& expect, const Numbers& numbers) {
  Judgement result = judge(ExpectedSameness{expect.relative}, numbers);
  result.relation = result.expected = "different";
  if (result.verdict != Verdict::CannotBeTold)
    result.verdict = result.verdict == Verdict::Holds ? Verdict::DoesNotHold : Verdict::Holds;
  return result;
}

}  // namespace burnish
