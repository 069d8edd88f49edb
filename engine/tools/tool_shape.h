#pragma once
#include <string>

#include "engine/schema/alternatives.h"
#include "engine/tools/shapes.h"
#include "engine/tools/union.h"

namespace burnish::inline tools {

/// The shape of a tool as a scene gives it: a simple one or a union of these.
using ToolShape = Extended<SimpleShape, UnionTool>;

/// What the key `file` of a shape means; none for a name that no shape has.
ShapeFile fileOf(const std::string& shape);

}  // namespace burnish::inline tools
