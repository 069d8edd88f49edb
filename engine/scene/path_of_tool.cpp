#include "engine/scene/path_of_tool.h"

namespace burnish {

ToolPath pathOf(const ToolSpec& tool) {
  const Eigen::Vector3d pivot =
      tool.pivot.empty() ? makeShape(tool.shape, tool.inside).middle() : Eigen::Vector3d(tool.pivot);
  return {*tool.path, pivot};
}

}  // namespace burnish
