#pragma once
#include "engine/scene/tool_spec.h"
#include "engine/tools/rigid_shape.h"

namespace burnish {

/// The rigid surface of a tool at its reference position. Throws `Error` if a file cannot be read or does not
/// hold a surface.
RigidShape makeShape(const ToolSpec& spec);

/// A list of two or three coordinates as a point in space.
Eigen::Vector3d inSpace(const std::vector<double>& coordinates);

}  // namespace burnish
