#include "engine/scene/scene_listing.h"

#include "engine/scene/mapping_lister.h"
#include "engine/scene/schema.h"

namespace burnish {

std::string describeScene() {
  return listKeys<Scene>();
}

}  // namespace burnish
