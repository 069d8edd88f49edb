#pragma once
#include <optional>

#include "engine/nurbs/patch.h"

namespace burnish::inline rezoning {

/// Whether the control points of a face have the same coordinate, but for rounding.
bool isFlat(const Patch<2>& mesh, FaceId face, int coordinate);

/// The mesh with its interior control points where an elastic sheet would take them that was a rectangle of
/// the given size, divided as the mesh is, before its boundary was given the mesh's shape: every knot span
/// counts the same. Control points slide along straight faces that are aligned with an axis, `fixed`
/// excepted. Nothing if that was not found. The determinant of the mesh's map must be positive.
std::optional<Patch<2>> relaxed(const Patch<2>& mesh, const Eigen::Vector2d& size, FaceId fixed);

}  // namespace burnish::inline rezoning
