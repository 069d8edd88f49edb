#pragma once
#include "engine/analysis/model.h"
#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// Throws `InputError` if the reference geometry of a body is none: the map of a patch has a negative determinant at
/// a corner of a knot span (where it may vanish, as it does at the pole of a ball), or in two dimensions the
/// outer boundary crosses itself.
template <int Dim>
void requireSoundGeometry(const Model<Dim>& model, const Scene& scene);

}  // namespace burnish::inline analysis
