#pragma once
#include <vector>

#include "engine/core/input_error.h"
#include "engine/material/material.h"

namespace burnish::inline analysis {

/// What is to be said of back stresses that do not recover: at most one warning.
std::vector<InputProblem> recoveryWarnings(const MaterialParameters& material);

}  // namespace burnish::inline analysis
