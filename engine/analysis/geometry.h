#pragma once
#include "engine/nurbs/patch.h"
#include "engine/scene/scene.h"

namespace burnish {

/// The reference geometry of a scene on the basis and degree that it asks for. Lagrange bases interpolate the
/// exact shape at their nodes. Throws `Error` for what the reader cannot see (knots or weights of a control
/// net that do not fit).
template <int Dim>
Patch<Dim> makePatch(const Scene& scene);

}  // namespace burnish
