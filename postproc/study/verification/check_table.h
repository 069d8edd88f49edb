#pragma once
#include <string>
#include <vector>

#include "postproc/study/verification/judgement.h"
#include "postproc/text/markdown.h"

namespace burnish {

/// The checks of a case as a Markdown table: a row for each check and family, a column for each mesh. With
/// `sources`, the names carry marks to where the expectations come from.
std::string checkTable(const VerificationCase& verified, const std::vector<JudgedCheck>& judged,
                       Footnotes* sources = nullptr);

/// A line of a list for each row that could not be judged, with the reason; empty if there is none.
std::string problemsText(const std::vector<JudgedCheck>& judged);

/// A line of a list for each condition that makes runs doubtful, whatever became of the checks: these runs,
/// and since when; and for each tool that never touches in some of them. Empty if there is none.
std::string doubtsText(const VerificationCase& verified, const CaseOutcomes& outcomes);

/// How many of the checks hold.
std::size_t numHolding(const std::vector<JudgedCheck>& judged);

}  // namespace burnish
