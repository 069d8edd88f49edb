#pragma once
#include <variant>

#include "engine/scene/scene.h"

namespace burnish {

/// Dimensions of a shape; 0 for a control net without degrees. Of several patches, those of the first.
inline int dimensionOf(const RectangleSpec&) {
  return 2;
}
inline int dimensionOf(const AnnulusSpec&) {
  return 2;
}
inline int dimensionOf(const DiscSpec&) {
  return 2;
}
inline int dimensionOf(const EllipseSpec&) {
  return 2;
}
inline int dimensionOf(const BoxSpec&) {
  return 3;
}
inline int dimensionOf(const TubeSpec&) {
  return 3;
}
inline int dimensionOf(const CylinderSpec&) {
  return 3;
}
inline int dimensionOf(const BallOctantSpec&) {
  return 3;
}
inline int dimensionOf(const ControlNetSpec& net) {
  return static_cast<int>(net.degrees.size());
}
int dimensionOf(const PatchesSpec& body);
template <class... Shape>
int dimensionOf(const std::variant<Shape...>& shape) {
  return std::visit([](const auto& one) { return dimensionOf(one); }, shape);
}

}  // namespace burnish
