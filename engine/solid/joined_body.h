#pragma once
#include <string>
#include <vector>

#include "engine/solid/body.h"

namespace burnish::inline solid {

/// A body of several patches. Control points of two faces that match (same control points within 1e-10 of the
/// body's size, same knots and weights, in any orientation) are one node, and so are those of a line of
/// control points that is collapsed to a point. `names`, one per patch, are for messages.
/// Throws `Error` if two faces lie on each other but do not match, or if the patches are not all connected
/// through common faces.
template <int Dim>
Body<Dim> joinedBody(std::vector<Patch<Dim>> patches, const std::vector<std::string>& names);

}  // namespace burnish::inline solid
