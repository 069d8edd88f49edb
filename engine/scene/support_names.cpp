#include "engine/scene/support_names.h"

#include <fmt/format.h>

namespace burnish::inline scene {

std::vector<std::string> supportNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const SupportSpec& support : scene.supports)
    names.push_back(support.name.empty() ? fmt::format("support{}", names.size() + 1) : support.name);
  return names;
}

}  // namespace burnish::inline scene
