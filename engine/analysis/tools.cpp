#include "engine/analysis/tools.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "engine/scene/path_of_tool.h"
#include "engine/tools/tool_shape.h"

namespace burnish::inline analysis {
namespace {

using TimeFunction = std::function<double(double)>;
using DofFunctions = std::array<TimeFunction, kToolDofs>;

constexpr double kRadians = std::numbers::pi / 180.0;

/// Values over the same times; empty functions for components that are left out.
DofFunctions tables(const ToolMotionSpec& motion) {
  DofFunctions dofs;
  const std::array components{&motion.x, &motion.y, &motion.z, &motion.angle};
  for (std::size_t dof = 0; dof < kToolDofs; ++dof)
    if (components[dof]->has_value()) dofs[dof] = Schedule{motion.times, **components[dof]};
  return dofs;
}

DofFunctions formulas(const std::array<const std::optional<FormulaText>*, kToolDofs>& components,
                      const std::vector<DefinitionSpec>& definitions) {
  DofFunctions dofs;
  for (std::size_t dof = 0; dof < kToolDofs; ++dof)
    if (components[dof]->has_value())
      dofs[dof] = [formula = Formula(**components[dof], definitions)](double t) {
        return formula(Eigen::Vector3d::Zero(), t);
      };
  return dofs;
}

/// Along the tool's path. A tool with the axis of a helix turns with its arm, so that it always shows the body the
/// same side; others do not turn.
DofFunctions alongPath(const ToolSpec& spec, const Eigen::Vector3d& axis) {
  constexpr double kParallel = 1e-9;
  const auto path = std::make_shared<const ToolPath>(pathOf(spec));
  DofFunctions dofs;
  for (std::size_t dof = 0; dof < kTurn; ++dof)
    dofs[dof] = [path, dof](double t) { return path->displacement(t)(static_cast<Eigen::Index>(dof)); };
  if (const double along = axis.dot(path->axis()); std::abs(along) > 1.0 - kParallel)
    dofs[kTurn] = [path, sign = along > 0.0 ? 1.0 : -1.0](double t) { return sign * path->turn(t); };
  return dofs;
}

}  // namespace

std::unique_ptr<Tool> makeTool(const ToolSpec& spec, const Scene& scene, int firstUnknown, double bodySize) {
  auto tool = std::make_unique<Tool>();
  tool->name = spec.name;
  tool->shape = makeShape(spec.shape, spec.inside);
  tool->pivot = spec.pivot.empty() ? tool->shape.middle() : Eigen::Vector3d(spec.pivot);
  tool->axis = spec.pivotAxis.normalized();
  tool->turnLength = bodySize;
  if (spec.motion) tool->motion = tables(*spec.motion);
  if (const auto& p = spec.prescribe)
    tool->motion = formulas({&p->x, &p->y, &p->z, &p->angle}, scene.definitions);
  if (tool->motion[kTurn])
    tool->motion[kTurn] = [degrees = tool->motion[kTurn]](double t) { return kRadians * degrees(t); };
  if (spec.path) tool->motion = alongPath(spec, tool->axis);
  if (const auto& carry = spec.carry) {
    const std::array isFree{carry->x.has_value(), carry->y.has_value(), carry->z.has_value(),
                            carry->moment.has_value()};
    if (carry->normal) tool->unknowns[kNormal] = firstUnknown++;
    for (std::size_t dof = 0; dof < kToolDofs; ++dof)
      if (isFree[dof]) tool->unknowns[dof] = firstUnknown++;
    for (std::size_t d = 0; d < kSpins && carry->spin; ++d) tool->unknowns[kSpin + d] = firstUnknown++;
    if (carry->spin) {
      tool->turnLength = tool->shape.halfThickness();  // the way that it rolls
      tool->motion[kTurn] = {};
    }
  }
  return tool;
}

std::unique_ptr<ToolLoad> makeToolLoad(const ToolSpec& spec, const Scene& scene, const Tool& tool,
                                       double bodySize) {
  if (!spec.carry) return nullptr;
  const auto& carry = *spec.carry;
  static_assert(kNormal == 0);
  DofFunctions loads = formulas({carry.normal ? &carry.normal : &carry.x, &carry.y, &carry.z, &carry.moment},
                                scene.definitions);
  if (carry.schedule)
    for (auto& load : loads)
      if (load) load = [load, factor = *carry.schedule](double t) { return factor(t) * load(t); };
  const std::optional<std::size_t> pressed = dofInHolder(spec);
  if (!pressed) return std::make_unique<ToolLoad>(tool, std::move(loads), bodySize);
  const auto path = std::make_shared<const ToolPath>(pathOf(spec));
  loads[*pressed] = [load = loads[*pressed], path](double t) { return path->forceShare(t) * load(t); };
  auto load = std::make_unique<ToolLoad>(tool, std::move(loads), bodySize);
  const bool presses = carry.normal || spec.path->clearance(static_cast<Eigen::Index>(*pressed)) > 0.0;
  load->setHolder({.dof = *pressed, .sign = presses ? -1.0 : 1.0, .mustCarry = [path](double t) {
                     return path->hasFullForce(t);
                   }});
  return load;
}

std::vector<double> cornersOf(const ToolSpec& spec) {
  std::vector<double> times;
  if (spec.motion) times = spec.motion->times;
  if (spec.path) times = pathOf(spec).corners();
  if (spec.carry && spec.carry->schedule)
    times.insert(times.end(), spec.carry->schedule->times.begin(), spec.carry->schedule->times.end());
  return times;
}

}  // namespace burnish::inline analysis
