#include "cli/init/scene_kinds.h"

#include "cli/init/kind_texts.h"

namespace burnish {

std::string SceneKind::sentence() const {
  return text.substr(2, text.find('\n') - 2);
}

std::vector<SceneKind> sceneKinds() {
  std::vector<SceneKind> kinds;
  for (const auto& [name, text] : kKindTexts) kinds.push_back({name, text});
  return kinds;
}

}  // namespace burnish
