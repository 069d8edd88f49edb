#include "engine/tools/mesh_tool.h"

#include "engine/tools/surface_file.h"

namespace burnish::inline tools {

FacetedShape MeshTool::made() const {
  return makeFacetedShape(readSurface(file, scale, open), smoothing);
}

}  // namespace burnish::inline tools
