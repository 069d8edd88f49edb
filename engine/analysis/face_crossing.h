#pragma once
#include <Eigen/Dense>

#include "engine/analysis/model.h"

namespace burnish::inline analysis {

/// Whether a contact face of a body crosses itself in the state x that the terms have been evaluated at (2D).
/// Parts that touch by self-contact do not.
template <int Dim>
bool anyFaceCrossesItself(const Model<Dim>& model, const ModelBody<Dim>& body, const Eigen::VectorXd& x);

}  // namespace burnish::inline analysis
