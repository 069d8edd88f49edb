#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/check_context.h"
#include "engine/scene/check_motion.h"
#include "engine/scene/path_of_tool.h"
#include "engine/tools/shape_problems.h"

namespace burnish::inline scene {
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

constexpr std::size_t kAxes = 3;
constexpr const char* kAcross = "motion across the axis of revolution";
constexpr const char* kTurning = "turn";

/// The part of a path that is wrong, if there is one, and what is.
struct PathProblem {
  std::string key, text;
};

std::optional<PathProblem> problemOf(const PolylinePath& course, std::size_t dim) {
  for (std::size_t k = 0; k < course.points.size(); ++k)
    if (course.points[k].size() != dim)
      return PathProblem{fmt::format("points[{}]", k),
                         fmt::format("found {} coordinates; allowed: {}.", course.points[k].size(), dim)};
  for (std::size_t k = 1; k < course.points.size(); ++k)
    if (course.points[k] == course.points[k - 1])
      return PathProblem{fmt::format("points[{}]", k),
                         "found the point before it again; allowed: a point elsewhere."};
  return std::nullopt;
}

std::optional<PathProblem> problemOf(const RasterPath& course, std::size_t /*dim*/) {
  if (course.stroke.isZero(0.0)) return PathProblem{"stroke", "found no length; allowed: the way of a pass."};
  return std::nullopt;
}

std::optional<PathProblem> problemOf(const HelixPath& course, std::size_t dim) {
  if (dim == 2) return PathProblem{"course", "found helix in two dimensions; allowed: polyline, raster."};
  if (course.axis.isZero(0.0))
    return PathProblem{"axis", "found no direction; allowed: a vector that is not zero."};
  return std::nullopt;
}

/// Whether a course goes round an axis on which the tool's pivot is, and not along it.
bool goesNowhere(const PathCourse& course, const ToolSpec& tool) {
  constexpr double kRounding = 1e-9;
  const auto* helix = std::get_if<HelixPath>(&course);
  if (helix == nullptr) return false;
  const Eigen::Vector3d arm = pivotOf(tool) - helix->center;
  return std::hypot(helix->axis.normalized().cross(arm).norm(), helix->pitch) <= kRounding * arm.norm();
}

/// The way on which the force of a pass comes and goes.
void checkRamp(const CheckContext& c, const std::string& path, const ToolSpec& spec) {
  if (spec.path->ramp == 0.0) return;
  if (!dofInHolder(spec))
    return c.report(
        path + ".ramp",
        "found although the tool carries no force along clearance; allowed: with carry in the direction "
        "in which clearance lifts the tool, on a helix with carry.normal.");
  constexpr double kRounding = 1e-9;
  const ToolPath laid = pathOf(spec);
  for (const ToolPath::Pass& pass : laid.touches())
    if (const double length = spec.path->speed * (pass.end - pass.begin);
        2.0 * spec.path->ramp > length * (1.0 + kRounding))
      return c.report(path + ".ramp",
                      fmt::format("found {:.6g}, twice, in a pass that is {:.6g} long; allowed: at most "
                                  "half of a pass.",
                                  spec.path->ramp, length));
}

/// A path, alone and beside the end of the run.
void checkPath(const CheckContext& c, const std::string& tool, const ToolSpec& spec) {
  const std::string path = tool + ".path";
  if (!c.clean(path) || !c.dimensionIsKnown()) return;
  if (spec.motion || spec.prescribe)
    return c.report(path, "found beside motion or prescribe; allowed: one of the three.");
  if (c.scene.kinematics == KinematicsChoice::Axisymmetric)
    return c.report(path, "found in axisymmetry; allowed: motion and prescribe along y.");
  const auto dim = static_cast<std::size_t>(c.scene.dim());
  if (const auto problem =
          std::visit([&](const auto& course) { return problemOf(course, dim); }, spec.path->course))
    return c.report(fmt::format("{}.{}", path, problem->key), problem->text);
  if (!c.clean("steps") || !c.clean(tool)) return;
  if (goesNowhere(spec.path->course, spec))
    return c.report(
        path,
        "found a helix that goes nowhere, as its axis leads through the tool's pivot; allowed: a tool "
        "off the axis, or a pitch that is not zero.");
  checkRamp(c, path, spec);
  const double end = c.scene.steps.back().until, needed = pathOf(spec).end();
  if (spec.until && *spec.until < needed * (1.0 - 1e-9))
    c.report(tool + ".until",
             fmt::format("found {}, before the path of the tool ends; allowed: {:.6g} or later.", *spec.until,
                         needed));
  if (needed > end * (1.0 + 1e-9))
    c.report(path,
             fmt::format("found a path that takes until t = {:.6g}, after the end of the run at {:.6g}; "
                         "allowed: more speed, or steps up to then.",
                         needed, end));
}

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
  if (tool.path) checkPath(c, path, tool);
}

/// Whether a component of a prescribed motion is given, by the place of its key in x, y, z, turn.
template <class Motion>
bool isGiven(const std::optional<Motion>& motion, std::size_t dof) {
  return motion && dofsOf(*motion, "angle", motion->angle)[dof].second->has_value();
}

/// Whether a path takes its tool along an axis.
bool movesAlong(const ToolPath& path, std::size_t axis) {
  constexpr int kSamples = 200;
  const auto at = [&](double t) { return path.displacement(t)(static_cast<Eigen::Index>(axis)); };
  std::vector<double> times = path.corners();
  for (int k = 1; k < kSamples; ++k)
    times.push_back(std::lerp(times.front(), path.end(), 1.0 * k / kSamples));
  const double first = at(times.front());
  return std::ranges::any_of(
      times, [&](double t) { return std::abs(at(t) - first) > 1e-12 * (1.0 + std::abs(first)); });
}

/// What the scene alone says of a ball that spins; whether the shape is one is seen when the tool is made.
void checkSpin(const CheckContext& c, const std::string& place, const ToolSpec& tool) {
  const std::string path = place + ".spin";
  if (!tool.carry->spin || !c.clean(path)) return;
  const auto isTurned = [](const auto& motion) { return motion && motion->angle; };
  if (c.dimensionIsKnown() && c.scene.dim() == 2)
    c.report(path, "found true in two dimensions; allowed: moment: 0, with which a disc turns freely.");
  else if (tool.carry->moment)
    c.report(path, "found true beside moment; allowed: one of the two.");
  else if (isTurned(tool.motion) || isTurned(tool.prescribe))
    c.report(path, "found true although the turn of the tool is prescribed; allowed: one of the two.");
  else if (tool.inside)
    c.report(path, "found true for a hollow; allowed: for balls.");
}

/// What a force along the normal excludes.
void checkNormal(const CheckContext& c, const std::string& place, const ToolSpec& tool) {
  const std::string path = place + ".normal";
  if (!tool.carry->normal || !c.clean(path)) return;
  for (const auto& [key, force] : componentsOf(*tool.carry))
    if (*force)
      return c.report(path, fmt::format("found beside {}; allowed: normal alone, or x, y and z.", key));
  if (c.scene.kinematics == KinematicsChoice::Axisymmetric)
    c.report(path, "found in axisymmetry, where tools move along the axis; allowed: y.");
  else if (tool.inside)
    c.report(path, "found for a hollow; allowed: for tools beside the body.");
}

/// Why a force along an axis and the path of its tool exclude one another.
std::string movedByPath(const PathSpec& path) {
  return std::holds_alternative<HelixPath>(path.course)
             ? "found although the helix moves the tool in this way; allowed: normal, a force that goes round with "
               "the tool."
             : "found although the path moves the tool in this way; allowed: one of the two, or normal, a force that "
               "follows the face.";
}

void checkCarry(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (!tool.carry) return;
  const std::string place = path + ".carry";
  const auto dofs = dofsOf(*tool.carry, "moment", tool.carry->moment);
  auto loads = dofs;
  loads.emplace(loads.begin() + kAxes, "normal", &tool.carry->normal);
  if (!tool.carry->spin) checkPresence(c, place, loads);
  checkEachFormula(c, place, loads, checkTimeFormula);
  checkSpin(c, place, tool);
  checkNormal(c, place, tool);
  checkAlongAxis(c, place, dofs, "force across the axis of revolution", "moment");
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const std::string key = fmt::format("{}.{}", place, dofs[k].first);
    if (dofs[k].second->has_value() && c.clean(key) &&
        (isGiven(tool.motion, k) || isGiven(tool.prescribe, k)))
      c.report(key, "found although the motion in this way is prescribed; allowed: one of the two.");
    else if (dofs[k].second->has_value() && k < kAxes && tool.path && c.clean(path) &&
             dofInHolder(tool) != k && movesAlong(pathOf(tool), k))
      c.report(key, movedByPath(*tool.path));
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
  checkRelease(c, path, tool);
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

}  // namespace burnish::inline scene
