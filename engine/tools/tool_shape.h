#pragma once
#include <string>
#include <utility>
#include <variant>

#include "engine/tools/shapes.h"
#include "engine/tools/union.h"

namespace burnish {

template <class... Simple>
std::variant<Simple..., UnionTool> orUnion(const std::variant<Simple...>& shape);

/// The shape of a tool as a scene gives it: a simple one or a union of these.
using ToolShape = decltype(orUnion(std::declval<SimpleShape>()));

/// What the key `file` of a shape means; none for a name that no shape has.
ShapeFile fileOf(const std::string& shape);

}  // namespace burnish
