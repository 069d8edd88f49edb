#pragma once
#include <vector>

#include "engine/core/input_error.h"
#include "engine/material/material.h"

namespace burnish {

/// What is to be said of back stresses that do not recover: at most one warning.
std::vector<InputProblem> recoveryWarnings(const MaterialParameters& material);

}  // namespace burnish
