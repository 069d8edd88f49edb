#include "postproc/study/evidence/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "postproc/study/evidence/quantity.h"
#include "postproc/study/evidence/refinement.h"
#include "postproc/text/ticks.h"

namespace burnish {
namespace {

constexpr int kDigits = 4;

/// A family that is checked, its row, and the numbers of all meshes.
struct Subject {
  const CaseFamily& family;
  CheckRow& row;
  std::vector<double> values;

  std::vector<double> constants(const FormulaText& formula) const {
    std::vector<double> constants;
    for (const CaseVariant& variant : family.variants)
      constants.push_back(Formula(formula, variant.definitions).constant());
    return constants;
  }
};

/// The first of the meshes that a value or range is judged on.
std::size_t firstJudged(const CheckSpec& check, std::size_t meshes) {
  return check.meshes == CheckSpec::Meshes::Every ? 0 : meshes - 1;
}

void judge(const CheckSpec& check, const ValueCheckSpec& expect, std::vector<Subject>& subjects) {
  for (const Subject& s : subjects) {
    const std::vector<double> expected = s.constants(expect.value);
    double largest = 0.0;
    for (std::size_t m = firstJudged(check, s.values.size()); m < s.values.size(); ++m) {
      const double difference = std::abs(s.values[m] - expected[m]);
      largest = std::max(largest, expect.relative ? difference / std::abs(expected[m]) : difference);
    }
    const double tolerance = expect.relative ? *expect.relative : expect.absolute.value();
    s.row.expected = numberText(expected.back(), kDigits);
    s.row.isShare = expect.relative.has_value();
    s.row.tolerance = numberText(s.row.isShare ? 100.0 * tolerance : tolerance, 2);
    s.row.deviation = largest;
    s.row.holds = largest <= tolerance;
  }
}

void judge(const CheckSpec& check, const RangeCheckSpec& expect, std::vector<Subject>& subjects) {
  for (const Subject& s : subjects) {
    std::vector<double> low(s.values.size(), -HUGE_VAL), high(s.values.size(), HUGE_VAL);
    if (expect.atLeast) low = s.constants(*expect.atLeast);
    if (expect.atMost) high = s.constants(*expect.atMost);
    s.row.holds = true;
    for (std::size_t m = firstJudged(check, s.values.size()); m < s.values.size(); ++m)
      s.row.holds &= s.values[m] >= low[m] && s.values[m] <= high[m];
    const std::string from = expect.atLeast ? numberText(low.back(), kDigits) : "";
    const std::string to = expect.atMost ? numberText(high.back(), kDigits) : "";
    s.row.expected = !expect.atMost    ? "≥ " + from
                     : !expect.atLeast ? "≤ " + to
                                       : fmt::format("{} to {}", from, to);
  }
}

/// The order between the two finest meshes whose errors are above the floor.
std::optional<double> judgedOrder(const std::vector<MeshValue>& errors, double floor) {
  std::vector<MeshValue> known;
  std::copy_if(errors.begin(), errors.end(), std::back_inserter(known),
               [&](const MeshValue& error) { return error.value > floor; });
  if (known.size() < 2) return {};
  return observedOrder(known[known.size() - 2], known.back(), 0.0);
}

void judge(const CheckSpec& /*check*/, const OrderCheckSpec& expect, std::vector<Subject>& subjects) {
  for (const Subject& s : subjects) {
    std::vector<MeshValue> errors;
    const std::vector<double> limits =
        expect.limit ? s.constants(*expect.limit) : std::vector<double>(s.values.size(), 0.0);
    for (std::size_t m = 0; m < s.values.size(); ++m) {
      errors.push_back({s.family.variants[m].size, std::abs(s.values[m] - limits[m])});
      s.row.values[m] = errors[m].value;
      if (m > 0) s.row.orders.push_back(observedOrder(errors[m - 1], errors[m], 0.0));
    }
    s.row.expected = fmt::format("order {:.2f}", expect.order);
    s.row.tolerance = fmt::format("−{:.2f}", expect.tolerance);
    const auto order = judgedOrder(errors, expect.floor);
    if (order)
      s.row.holds = *order >= expect.order - expect.tolerance;
    else
      s.row.problem = fmt::format("fewer than two meshes have errors above {:.2g}", expect.floor);
  }
}

void judge(const CheckSpec& /*check*/, const MonotoneCheckSpec& expect, std::vector<Subject>& subjects) {
  const bool increasing = expect.direction == MonotoneCheckSpec::Direction::Increasing;
  for (const Subject& s : subjects) {
    s.row.holds = std::adjacent_find(s.values.begin(), s.values.end(), [&](double a, double b) {
                    return increasing ? !(a < b) : !(a > b);
                  }) == s.values.end();
    s.row.expected = increasing ? "increasing" : "decreasing";
  }
}

void judge(const CheckSpec& /*check*/, const SameCheckSpec& expect, std::vector<Subject>& subjects) {
  const auto [low, high] = std::minmax_element(
      subjects.begin(), subjects.end(),
      [](const Subject& a, const Subject& b) { return a.values.back() < b.values.back(); });
  const double from = low->values.back(), to = high->values.back();
  const double largest = std::max(std::abs(from), std::abs(to));
  const double deviation = largest > 0.0 ? (to - from) / largest : 0.0;
  for (const Subject& s : subjects) {
    s.row.expected = "the same";
    s.row.isShare = true;
    s.row.tolerance = numberText(100.0 * expect.relative, 2);
    s.row.deviation = deviation;
    s.row.holds = deviation <= expect.relative;
  }
}

/// Fills the values of a row; what goes wrong is its problem.
void evaluateRow(const CheckSpec& check, const CaseFamily& family,
                 const std::vector<VariantOutcome>& outcomes, CheckRow& row) {
  for (std::size_t m = 0; m < outcomes.size(); ++m) {
    const CaseVariant& variant = family.variants[m];
    std::string failure = outcomes[m].failure;
    std::optional<double> value;
    try {
      if (outcomes[m].history) value = quantityOf(check, *outcomes[m].history, variant.definitions);
    } catch (const Error& error) {
      failure = error.what();
    }
    row.values.push_back(value);
    if (!value && row.problem.empty())
      row.problem = variant.mesh.empty() ? failure : fmt::format("{}: {}", variant.mesh, failure);
  }
}

JudgedCheck judgeCheck(const VerificationCase& verified, const CaseOutcomes& outcomes,
                       const CheckSpec& check) {
  JudgedCheck judged{&check, {}};
  std::vector<std::size_t> chosen;
  for (std::size_t f = 0; f < verified.families.size(); ++f) {
    const std::string& name = verified.families[f].name;
    const auto& wanted = check.families;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    chosen.push_back(f);
    CheckRow& row = judged.rows.emplace_back();
    row.family = name;
    evaluateRow(check, verified.families[f], outcomes[f], row);
  }
  std::vector<Subject> subjects;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    CheckRow& row = judged.rows[k];
    if (!row.problem.empty()) continue;
    Subject& subject = subjects.emplace_back(Subject{verified.families[chosen[k]], row, {}});
    for (const auto& value : row.values) subject.values.push_back(value.value());
  }
  const bool all = subjects.size() == judged.rows.size();
  if (std::holds_alternative<SameCheckSpec>(check.expect) && !all) {
    for (const Subject& subject : subjects) subject.row.problem = "another family has no value";
    return judged;
  }
  std::visit([&](const auto& expect) { judge(check, expect, subjects); }, check.expect);
  return judged;
}

}  // namespace

bool JudgedCheck::holds() const {
  return std::all_of(rows.begin(), rows.end(), [](const CheckRow& row) { return row.holds; });
}

std::vector<JudgedCheck> judgeChecks(const VerificationCase& verified, const CaseOutcomes& outcomes) {
  std::vector<JudgedCheck> judged;
  for (const CheckSpec& check : verified.document.checks)
    judged.push_back(judgeCheck(verified, outcomes, check));
  return judged;
}

}  // namespace burnish
