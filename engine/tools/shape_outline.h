#pragma once
#include "engine/tools/rigid_shape.h"
#include "engine/tools/surface_mesh.h"

namespace burnish {

/// The surface of a shape, to be drawn in `dim` dimensions: roundings in pieces of 5 degrees. Infinite shapes
/// are cut at the distance `reach` from their own point (origin, tip, center).
SurfaceMesh outlineOf(const RigidShape& shape, int dim, double reach);

}  // namespace burnish
