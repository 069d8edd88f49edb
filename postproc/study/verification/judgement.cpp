#include "postproc/study/verification/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "postproc/study/evidence/quantity.h"

namespace burnish {
namespace {

/// A family that is checked, and its row.
struct Subject {
  const CaseFamily& family;
  CheckRow& row;

  /// The numbers of the meshes from one on.
  std::vector<Observed> numbers(std::size_t first) const {
    std::vector<Observed> numbers;
    for (std::size_t m = first; m < row.values.size(); ++m)
      numbers.push_back({row.values[m], family.variants[m].size, &family.variants[m].definitions});
    return numbers;
  }
};

/// Whether the numbers of the families are compared with each other.
bool comparesFamilies(const CheckExpectation& expect) {
  return std::holds_alternative<ExpectedSameness>(expect);
}

/// The first of the meshes that are judged.
std::size_t firstJudged(const CheckSpec& check, std::size_t meshes) {
  const bool ofEachMesh = std::holds_alternative<ExpectedValue>(check.expect) ||
                          std::holds_alternative<ExpectedRange>(check.expect);
  return ofEachMesh && check.meshes == CheckSpec::Meshes::Finest ? meshes - 1 : 0;
}

void fill(CheckRow& row, Judgement judgement) {
  if (!judgement.errors.empty()) row.values = judgement.errors;
  static_cast<Judgement&>(row) = std::move(judgement);
}

void judgeFamilies(const CheckSpec& check, const std::vector<Subject>& subjects) {
  if (!comparesFamilies(check.expect)) {
    for (const Subject& s : subjects)
      fill(s.row, judge(check.expect, s.numbers(firstJudged(check, s.row.values.size()))));
    return;
  }
  std::vector<Observed> finest;
  for (const Subject& s : subjects) finest.push_back({s.row.values.back()});
  for (const Subject& s : subjects) fill(s.row, judge(check.expect, finest));
}

/// Fills the values of a row; what goes wrong is its problem.
void evaluateRow(const CheckSpec& check, const CaseFamily& family,
                 const std::vector<VariantOutcome>& outcomes, CheckRow& row) {
  for (std::size_t m = 0; m < outcomes.size(); ++m) {
    const CaseVariant& variant = family.variants[m];
    std::string failure = outcomes[m].failure;
    std::optional<double> value;
    try {
      if (outcomes[m].history) value = valueOf(check.quantity, *outcomes[m].history, variant.definitions);
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
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (judged.rows[k].problem.empty()) subjects.push_back({verified.families[chosen[k]], judged.rows[k]});
  if (comparesFamilies(check.expect) && subjects.size() < judged.rows.size())
    for (const Subject& subject : subjects) subject.row.problem = "another family has no value";
  else
    judgeFamilies(check, subjects);
  return judged;
}

}  // namespace

bool JudgedCheck::holds() const {
  return std::all_of(rows.begin(), rows.end(), [](const CheckRow& row) { return row.holds(); });
}

std::vector<JudgedCheck> judgeChecks(const VerificationCase& verified, const CaseOutcomes& outcomes) {
  std::vector<JudgedCheck> judged;
  for (const CheckSpec& check : verified.document.checks)
    judged.push_back(judgeCheck(verified, outcomes, check));
  return judged;
}

}  // namespace burnish
