#pragma once
#include "engine/analysis/model.h"
#include "engine/nurbs/coarsening.h"
#include "engine/solver/hierarchy.h"

namespace burnish::inline analysis {

/// Nested spaces of a model's free displacement components, coarser and coarser until there are no more than
/// `coarsest` of them or no spans are left to merge.
template <int Dim>
Hierarchy makeHierarchy(const Model<Dim>& model, const MergeRule& rule, int coarsest);

}  // namespace burnish::inline analysis
