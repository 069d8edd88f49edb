#include "engine/scene/scene.h"

#include "engine/scene/dimension.h"

namespace burnish {

int dimensionOf(const PatchesSpec& body) {
  return body.patches.empty() ? 0 : dimensionOf(body.patches.front().shape);
}

int Scene::dim() const {
  return dimensionOf(geometry.shape);
}

}  // namespace burnish
