#pragma once
#include "engine/analysis/model.h"
#include "engine/scene/scene.h"
#include "engine/solver/stepping.h"

namespace burnish::inline analysis {

/// Places the tools at the undeformed body and returns the state in which a run begins.
///
/// A tool in prescribed motion is lifted so that no averaged gap is negative, and comes down before t = 0:
/// the state's time. Functions of a Lagrange basis have negative lobes, whose averaged gaps can be negative
/// although nothing touches, and the first step would start with a jump. A tool that carries a load is moved
/// along it until it touches the body. Throws `InputError` for a tool that cannot be lifted, does not meet
/// the body, or moves in itself in a free degree of freedom.
template <int Dim>
SteppingState placeTools(const Scene& scene, Model<Dim>& model);

/// What `placeTools` tells tools that carry loads of the body that they touch, for a model of a deformed body, beside which
/// they are where they have come to. Throws as that does.
template <int Dim>
void prepareTools(const Scene& scene, Model<Dim>& model);

}  // namespace burnish::inline analysis
