#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/solid/bodies/net.h"

/// What bodies that are made from curves and faces share.
namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline solid {

/// Dimensions of a body made from a curve or a face: one more; 0 without degrees.
inline int dimensionFrom(const Net& profile) {
  return profile.degrees.empty() ? 0 : static_cast<int>(profile.degrees.size()) + 1;
}

/// A curve in the plane, or a face in it or in space, at the key `profile`.
void checkProfile(const Net& profile, const Problems& problems);

/// A patch as one of its own number of dimensions.
Patch<2> inOwnSpace(const Patch<2, 3>& face);
Patch<3> inOwnSpace(const Patch<3, 3>& volume);

/// The knots of a body of either dimension, as `patch` makes it.
template <class Shape>
std::vector<KnotVector> madeKnots(const Shape& shape) {
  return shape.dim() == 2 ? knotVectorsOf(shape.template patch<2>())
                          : knotVectorsOf(shape.template patch<3>());
}

}  // namespace burnish::inline solid
