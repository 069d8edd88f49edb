#pragma once
#include <string>
#include <vector>

#include "postproc/study/evidence/expectation.h"
#include "postproc/study/measures.h"

namespace burnish {

/// A claim for one combination of its parameters, and what became of it.
struct JudgedClaim {
  std::string text;
  Verdict verdict = Verdict::CannotBeTold;
  std::string numbers;  ///< the values compared, in words
};

/// All claims of a statement in their order. faults: see `measuredOrFault`. Throws `Error` for runs and measures that do not
/// exist.
std::vector<JudgedClaim> judgeClaims(const Study& study, const StatementSpec& statement,
                                     const std::filesystem::path& studyDirectory, SeenProfiles& seen,
                                     std::vector<std::string>& faults);

}  // namespace burnish
