#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/scene/check_context.h"
#include "engine/scene/check_motion.h"
#include "engine/tools/shape_problems.h"

namespace burnish {
namespace {

/// The degrees of freedom in which a tool moves or carries a load, by key: displacements and the turn.
template <class Spec, class T>
Components<T> dofsOf(const Spec& s, const char* turnKey, const std::optional<T>& turn) {
  auto dofs = componentsOf(s);
  dofs.emplace_back(turnKey, &turn);
  return dofs;
}

/// In axisymmetry a tool moves along the axis alone. across, around: words for the other degrees of freedom.
template <class T>
void checkAlongAxis(const CheckContext& c, const std::string& path, const Components<T>& dofs,
                    const char* across, const char* around) {
  if (c.scene.kinematics != KinematicsChoice::Axisymmetric) return;
  for (const auto& [key, dof] : dofs)
    if (*dof && std::string(key) != "y" && c.clean(fmt::format("{}.{}", path, key)))
      c.report(fmt::format("{}.{}", path, key), fmt::format("found a {}; allowed in axisymmetry: y alone.",
                                                            std::string(key) == "x" ? across : around));
}

constexpr const char* kAcross = "motion across the axis of revolution";
constexpr const char* kTurning = "turn";

void checkMotion(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (tool.motion) {
    const auto dofs = dofsOf(*tool.motion, "angle", tool.motion->angle);
    checkTable(c, path + ".motion", tool.motion->times, dofs);
    checkAlongAxis(c, path + ".motion", dofs, kAcross, kTurning);
  }
  if (tool.prescribe) {
    const auto dofs = dofsOf(*tool.prescribe, "angle", tool.prescribe->angle);
    checkFormulas(c, path + ".prescribe", dofs, checkTimeFormula);
    checkAlongAxis(c, path + ".prescribe", dofs, kAcross, kTurning);
  }
  if (tool.motion && tool.prescribe && c.clean(path + ".prescribe"))
    c.report(path + ".prescribe", "found beside motion; allowed: one of motion and prescribe.");
}

/// Whether a component of a prescribed motion is given, by the place of its key in x, y, z, turn.
template <class Motion>
bool isGiven(const std::optional<Motion>& motion, std::size_t dof) {
  return motion && dofsOf(*motion, "angle", motion->angle)[dof].second->has_value();
}

void checkCarry(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (!tool.carry) return;
  const std::string place = path + ".carry";
  const auto dofs = dofsOf(*tool.carry, "moment", tool.carry->moment);
  checkFormulas(c, place, dofs, checkTimeFormula);
  checkAlongAxis(c, place, dofs, "force across the axis of revolution", "moment");
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::string key = fmt::format("{}.{}", place, dofs[k].first);
    if (dofs[k].second->has_value() && c.clean(key) &&
        (isGiven(tool.motion, k) || isGiven(tool.prescribe, k)))
      c.report(key, "found although the motion in this way is prescribed; allowed: one of the two.");
  }
  if (tool.carry->schedule && c.clean(place + ".schedule"))
    checkSchedule(c, place + ".schedule", *tool.carry->schedule);
}

void checkTool(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  const ShapeProblems problems(Problems(c.root, c.errors, path),
                               {.dim = c.dimensionIsKnown() ? c.scene.dim() : 0,
                                .axisymmetric = c.scene.kinematics == KinematicsChoice::Axisymmetric});
  if (c.clean(path + ".shape")) checkShape(tool.shape, problems);
  problems.requireAxis("pivot_axis", tool.pivotAxis);
  checkMotion(c, path, tool);
  checkCarry(c, path, tool);
}

/// Names of all tools that could be read; a name given twice is reported.
std::vector<std::string> checkToolNames(const CheckContext& c) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < c.scene.tools.size(); ++i) {
    const std::string& name = c.scene.tools[i].name;
    const std::string path = fmt::format("tools[{}].name", i);
    if (!c.clean(path)) continue;
    if (std::find(names.begin(), names.end(), name) != names.end())
      c.report(
          path,
          fmt::format("found {}, the name of another tool; allowed: a name of its own for each tool.", name));
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::vector<std::string> checkTools(const CheckContext& c) {
  for (std::size_t i = 0; i < c.scene.tools.size(); ++i)
    checkTool(c, fmt::format("tools[{}]", i), c.scene.tools[i]);
  return checkToolNames(c);
}

}  // namespace burnish
