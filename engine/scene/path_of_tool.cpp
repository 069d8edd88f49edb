#include "engine/scene/path_of_tool.h"

namespace burnish {

Eigen::Vector3d pivotOf(const ToolSpec& tool) {
  return tool.pivot.empty() ? makeShape(tool.shape, tool.inside).middle() : Eigen::Vector3d(tool.pivot);
}

ToolPath pathOf(const ToolSpec& tool) {
  return {*tool.path, pivotOf(tool)};
}

}  // namespace burnish
