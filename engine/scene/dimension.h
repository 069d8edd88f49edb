#pragma once
#include <variant>

#include "engine/scene/scene.h"

namespace burnish {

/// Dimensions of a shape; 0 for a control net without degrees. Of several patches, those of the first.
template <class Shape>
int dimensionOf(const Shape& /*shape*/) {
  return static_cast<int>(Shape::kind.degrees.size());
}
inline int dimensionOf(const ControlNetBody& net) {
  return static_cast<int>(net.degrees.size());
}
int dimensionOf(const PatchesSpec& body);
template <class... Shape>
int dimensionOf(const std::variant<Shape...>& shape) {
  return std::visit([](const auto& one) { return dimensionOf(one); }, shape);
}

}  // namespace burnish
