#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/evidence/expectation.h"
#include "postproc/study/verification/verification_case.h"

namespace burnish {

/// What became of a check in one family. Nothing is judged where a value is missing.
struct CheckRow : Judgement {
  std::string family;
  /// One per mesh, coarse to fine: the quantity, or the error if an order is checked.
  std::vector<std::optional<double>> values;

  bool holds() const { return verdict == Verdict::Holds; }
};

struct JudgedCheck {
  const CheckSpec* check = nullptr;
  std::vector<CheckRow> rows;  ///< one for each family that is checked

  bool holds() const;
};

/// Outcomes of a case: of each family, of each of its meshes.
using CaseOutcomes = std::vector<std::vector<VariantOutcome>>;

/// Judges all checks of a case, which must outlive the result. A check fails in a family if one of its runs
/// has failed or its quantity cannot be evaluated on one of the meshes.
std::vector<JudgedCheck> judgeChecks(const VerificationCase& verified, const CaseOutcomes& outcomes);

}  // namespace burnish
