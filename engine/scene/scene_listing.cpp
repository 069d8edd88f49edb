#include "engine/scene/scene_listing.h"

#include "engine/scene/declaration_collector.h"
#include "engine/scene/schema.h"

namespace burnish {

Declarations sceneDeclarations() {
  return declarationsOf<Scene>();
}

std::string describeScene() {
  return listKeys(sceneDeclarations());
}

}  // namespace burnish
