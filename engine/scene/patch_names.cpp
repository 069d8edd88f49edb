#include "engine/scene/patch_names.h"

namespace burnish::inline scene {

std::vector<std::string> patchNames(const BodySpec& body) {
  std::vector<std::string> names;
  if (const auto* several = std::get_if<PatchesSpec>(&body.geometry.shape))
    for (const PatchSpec& patch : several->patches) names.push_back(patch.name);
  return names;
}

}  // namespace burnish::inline scene
