#include "engine/scene/scene_places.h"

namespace burnish::inline scene {

std::string textWithPlaces(const Scene& scene, const std::vector<InputProblem>& problems) {
  if (!scene.places) return InputError(problems).what();
  Diagnostics found = scene.places->files;
  for (const auto& [path, text] : problems) found.add(placeOf(scene.places->root, path), path, text);
  return found.text();
}

}  // namespace burnish::inline scene
