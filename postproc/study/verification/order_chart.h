#pragma once
#include <filesystem>
#include <vector>

#include "postproc/study/verification/judgement.h"

namespace burnish {

/// Draws errors over the size of the cells or steps, both on logarithmic axes, with dashed lines of the orders that
/// theory has: one chart for all checks of orders of one quantity, NAME-1.png, NAME-2.png, … in the
/// directory, which is made if needed. The files, none if no order is checked or known. Throws `Error` if a
/// file cannot be written.
std::vector<std::filesystem::path> drawOrderCharts(const VerificationCase& verified,
                                                   const std::vector<JudgedCheck>& judged,
                                                   const std::filesystem::path& directory);

}  // namespace burnish
