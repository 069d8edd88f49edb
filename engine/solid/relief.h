#pragma once
#include <functional>

#include "engine/nurbs/patch.h"

namespace burnish::inline solid {

/// A patch with a relief on one of its faces: each of the face's anchors (Greville abscissae, nodes of Lagrange
/// elements) is moved along the outward normal there, by the height at its place, and the face interpolates these places.
/// Inside, the control points go along the less, the farther they are from the face, those of the opposite face not at
/// all. height: of a place on the face as it was. Throws what `height` throws.
template <int Dim>
Patch<Dim> withRelief(const Patch<Dim>& patch, FaceId face,
                      const std::function<double(const Eigen::Vector<double, Dim>&)>& height);

}  // namespace burnish::inline solid
