#pragma once
#include <filesystem>
#include <vector>

#include "postproc/study/verification/judgement.h"

namespace burnish {

/// Draws the charts of a case from the histories of its runs or along their contact faces at the end,
/// NAME-curve-1.png, … in the directory, which is made if needed. Runs without a history are left out. Throws
/// `Error` for formulas that cannot be evaluated, contacts that a result does not have, and files that cannot
/// be written.
std::vector<std::filesystem::path> drawHistoryCharts(const VerificationCase& verified,
                                                     const CaseOutcomes& outcomes,
                                                     const std::filesystem::path& directory);

}  // namespace burnish
