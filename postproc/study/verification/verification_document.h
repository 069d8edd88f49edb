#pragma once
#include <filesystem>
#include <vector>

#include "postproc/study/verification/judgement.h"

namespace burnish {

struct VerifiedCase {
  const VerificationCase* verified = nullptr;
  CaseOutcomes outcomes;
  std::vector<JudgedCheck> judged;
};

/// Writes what is verified and how well: a table of all cases, then each with its explanation, the values on
/// all meshes, expectations, sources and verdicts, and its charts, which go to the directory `pictures`.
/// Equal results give equal bytes. Throws `Error` for files that cannot be written.
void writeVerification(const std::vector<VerifiedCase>& cases, const std::filesystem::path& file,
                       const std::filesystem::path& pictures);

}  // namespace burnish
