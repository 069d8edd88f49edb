#pragma once
#include <optional>
#include <string>
#include <vector>

#include "postproc/study/evidence/verification_case.h"

namespace burnish {

/// What became of a check in one family.
struct CheckRow {
  std::string family;
  /// One per mesh, coarse to fine: the quantity, or the error if an order is checked.
  std::vector<std::optional<double>> values;
  std::vector<std::optional<double>> orders;  ///< observed from each mesh to the next
  std::string expected, tolerance;
  std::optional<double>
      deviation;         ///< the largest of the meshes that are judged, in the measure of the tolerance
  bool isShare = false;  ///< deviation and tolerance are parts of a value
  bool holds = false;
  std::string problem;  ///< why nothing could be judged
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
