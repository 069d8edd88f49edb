#include "engine/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/dimension.h"

namespace burnish::inline scene {

int dimensionOf(const PatchesSpec& body) {
  return body.patches.empty() ? 0 : dimensionOf(body.patches.front().shape);
}

std::vector<FaceSpec> SelfContactSpec::places() const {
  if (faces.empty()) return {place};
  std::vector<FaceSpec> all(faces.size(), place);
  for (std::size_t k = 0; k < faces.size(); ++k) all[k].face = faces[k];
  return all;
}

std::string pairName(const ContactSpec& pair) {
  if (!pair.name.empty()) return pair.name;
  const bool named = !pair.place.body.empty() && pair.place.body != pair.against.front().body;
  const FaceSpec& against = pair.against.front();
  return named ? pair.place.body + "-" + against.body : pair.place.face + "-" + against.face;
}

std::string againstKey(const ContactSpec& pair, const std::string& path, std::size_t number) {
  return pair.against.size() == 1 ? path + ".against" : fmt::format("{}.against[{}]", path, number);
}

int Scene::dim() const {
  return dimensionOf(allBodies().front().geometry.shape);
}

std::span<const BodySpec> Scene::allBodies() const {
  return bodies.empty() ? std::span(&body, 1) : std::span(bodies);
}

std::size_t Scene::bodyNumber(const std::string& name) const {
  const auto found = std::ranges::find(bodies, name, &BodySpec::name);
  return found == bodies.end() ? 0 : static_cast<std::size_t>(found - bodies.begin());
}

std::string Scene::bodyKey(std::size_t number, const std::string& key) const {
  return bodies.empty() ? key : fmt::format("bodies[{}].{}", number, key);
}

}  // namespace burnish::inline scene
