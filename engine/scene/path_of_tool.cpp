#include "engine/scene/path_of_tool.h"

#include <array>
#include <variant>

#include "engine/tools/tool.h"

namespace burnish::inline scene {

Eigen::Vector3d pivotOf(const ToolSpec& tool) {
  return tool.pivot.empty() ? makeShape(tool.shape, tool.inside).middle() : Eigen::Vector3d(tool.pivot);
}

ToolPath pathOf(const ToolSpec& tool) {
  return {*tool.path, pivotOf(tool)};
}

std::optional<std::size_t> dofInHolder(const ToolSpec& tool) {
  if (!tool.path || !tool.carry) return std::nullopt;
  if (tool.carry->normal) return tool.path->clearance.isZero(0.0) ? std::nullopt : std::optional(kNormal);
  if (std::holds_alternative<HelixPath>(tool.path->course)) return std::nullopt;
  const std::array carried{tool.carry->x.has_value(), tool.carry->y.has_value(), tool.carry->z.has_value()};
  for (std::size_t dof = 0; dof < carried.size(); ++dof)
    if (carried[dof] && tool.path->clearance(static_cast<Eigen::Index>(dof)) != 0.0) return dof;
  return std::nullopt;
}

}  // namespace burnish::inline scene
