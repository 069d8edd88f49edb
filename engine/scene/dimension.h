#pragma once
#include <variant>

#include "engine/scene/scene.h"

namespace burnish::inline scene {

/// Dimensions of a shape; 0 where they follow from degrees that are not there. Of several patches, those of the first.
template <class Shape>
int dimensionOf(const Shape& shape) {
  if constexpr (BringsKnots<Shape>)
    return shape.dim();
  else
    return static_cast<int>(Shape::kind.degrees.size());
}
int dimensionOf(const PatchesSpec& body);
template <class... Shape>
int dimensionOf(const std::variant<Shape...>& shape) {
  return std::visit([](const auto& one) { return dimensionOf(one); }, shape);
}

}  // namespace burnish::inline scene
