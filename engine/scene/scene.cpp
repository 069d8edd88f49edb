#include "engine/scene/scene.h"

namespace burnish {

int Scene::dim() const {
  if (const auto* net = std::get_if<ControlNetSpec>(&geometry.shape))
    return static_cast<int>(net->degrees.size());
  return std::holds_alternative<BoxSpec>(geometry.shape) ? 3 : 2;
}

}  // namespace burnish
