#pragma once
#include <variant>

#include "engine/tools/cylinder.h"
#include "engine/tools/plane.h"
#include "engine/tools/sphere.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// What is kept of a tool's shape: these as they are, others as they are drawn.
using RecordedShape = std::variant<Plane, Cylinder, Sphere, SurfaceMesh>;

}  // namespace burnish::inline tools
