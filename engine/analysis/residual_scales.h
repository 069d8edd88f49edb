#pragma once
#include "engine/analysis/model.h"
#include "engine/solver/newton.h"

namespace burnish::inline analysis {

/// How residuals of a model are measured: forces by those that act, averaged gaps by the body's size.
template <int Dim>
ResidualScales residualScales(const Model<Dim>& model);

}  // namespace burnish::inline analysis
