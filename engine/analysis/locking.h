#pragma once
#include <vector>

#include "engine/analysis/model.h"
#include "engine/core/input_error.h"

namespace burnish::inline analysis {

/// What the displacement formulation answers wrongly in a scene, because the body can hardly change its
/// volume: from a Poisson's ratio on that depends on the degree, and where J2 plasticity flows. Nothing with
/// F-bar.
template <int Dim>
std::vector<InputProblem> lockingWarnings(const Scene& scene, const Model<Dim>& model);

}  // namespace burnish::inline analysis
