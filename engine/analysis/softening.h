#pragma once
#include <vector>

#include "engine/core/input_error.h"
#include "engine/material/material.h"

namespace burnish::inline analysis {

/// What is to be said of a hardening law whose yield stress falls, or vanishes, in the range of plastic
/// strains that bodies come to: at most one warning.
std::vector<InputProblem> softeningWarnings(const Material& material);

}  // namespace burnish::inline analysis
