#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "postproc/study/evidence/measures.h"

namespace burnish {

enum class Verdict { Holds, DoesNotHold, CannotBeTold };

/// "holds", "does not hold", "cannot be told".
std::string verdictText(Verdict verdict);

/// A run's name in a text and what its measure came to.
struct ClaimedValue {
  std::string run;
  Measured measured;
};

/// A claim for one combination of its parameters, and what became of it.
struct JudgedClaim {
  std::string text;
  Verdict verdict = Verdict::CannotBeTold;
  std::string numbers;  ///< the values compared, in words
};

/// Whether each value that is known is larger than the known ones before. It does not hold as soon as two
/// known values show it, and cannot be told if values are missing.
Verdict judgeIncreasing(const std::vector<ClaimedValue>& values);

/// Whether the values differ by no more than `within` times the largest magnitude.
Verdict judgeEqual(const std::vector<ClaimedValue>& values, double within);

/// Whether all values lie in a range, ends included.
Verdict judgeBetween(const std::vector<ClaimedValue>& values, const std::array<double, 2>& range);

/// All claims of a statement in their order. Throws `Error` for runs and measures that do not exist.
std::vector<JudgedClaim> judgeClaims(const Study& study, const StatementSpec& statement,
                                     const std::filesystem::path& studyDirectory);

}  // namespace burnish
