#include "engine/scene/check.h"

#include "engine/scene/check_context.h"

namespace burnish::inline scene {

void checkScene(const Scene& scene, const YamlNode& root, Diagnostics& errors) {
  const CheckContext context{scene, root, errors};
  checkDefinitions(context);
  checkBodies(context);
  checkBoundary(context);
  checkMeasures(context);
  checkRezoning(context);
  checkRun(context);
}

}  // namespace burnish::inline scene
