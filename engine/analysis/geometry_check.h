#pragma once
#include "engine/analysis/face_finder.h"
#include "engine/scene/scene.h"

namespace burnish {

/// Throws `InputError` if the reference geometry is no body: the map of a patch has a negative determinant at
/// a corner of a knot span (where it may vanish, as it does at the pole of a ball), or in two dimensions the
/// outer boundary crosses itself.
template <int Dim>
void requireSoundGeometry(const FaceFinder<Dim>& faces, const Scene& scene);

}  // namespace burnish
