#include "postproc/indentation/indentation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/results/history.h"
#include "engine/scene/reader.h"
#include "engine/scene/scene.h"

namespace burnish {
namespace {

const ToolSpec& toolOf(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) names.push_back(tool.name);
  if (names.empty()) throw Error("tool: the run has no tool that could be an indenter");
  if (name.empty() && names.size() > 1)
    throw Error(fmt::format("tool: there are the tools {}; expected one of them", fmt::join(names, ", ")));
  if (name.empty()) return scene.tools.front();
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw Error(
        fmt::format("tool: found {}; the run has the tools {}", quoted(name), fmt::join(names, ", ")));
  return scene.tools[static_cast<std::size_t>(found - names.begin())];
}

/// An indenter and where its tip stands at the start.
struct Placed {
  Indenter indenter;
  Eigen::Vector2d tip;
};

Placed placedOf(const ToolSpec& tool) {
  if (const auto* disc = std::get_if<Cylinder>(&tool.shape); disc != nullptr && !tool.inside)
    return {SphereIndenter{disc->radius}, {disc->center[0], disc->center[1] - disc->radius}};
  if (const auto* cone = std::get_if<Cone>(&tool.shape); cone != nullptr && !tool.inside)
    if (cone->direction[0] == 0.0 && cone->direction[1] < 0.0)
      return {ConeIndenter{cone->halfAngle * std::numbers::pi / 180.0, cone->radius},
              {cone->tip[0], cone->tip[1]}};
  throw Error(
      fmt::format("tool: {} is neither a sphere (shape: cylinder of a body of revolution) nor a cone that "
                  "points down",
                  quoted(tool.name)));
}

/// E and ν of laws that have them.
struct Elastic {
  std::optional<double> E, nu;
};

Elastic elasticOf(const MaterialParameters& material) {
  return std::visit(
      [](const auto& law) -> Elastic {
        Elastic found;
        if constexpr (requires { law.E; }) found.E = law.E;
        if constexpr (requires { law.nu; }) found.nu = law.nu;
        return found;
      },
      material);
}

double highestPointOf(const ModelRecord& model) {
  double highest = -HUGE_VAL;
  for (const PatchRecord& patch : model.mesh.patches)
    highest = std::max(highest, patch.points.row(1).maxCoeff());
  return highest;
}

/// Where the pressure ends, from the points at which it is known; how far off it may be was seen in elastic bodies, where
/// the answer is known.
struct Radius {
  double value, uncertainty;
};

std::optional<Radius> contactRadius(const FrameRecord& frame, const std::string& tool) {
  constexpr double kOff = 1.5;
  for (const ContactRecord& contact : frame.contact) {
    if (contact.tool != tool) continue;
    double inside = 0.0, outside = HUGE_VAL;
    for (Eigen::Index k = 0; k < contact.quadraturePressure.size(); ++k)
      if (contact.quadraturePressure(k) > 0.0) inside = std::max(inside, contact.quadraturePoints(0, k));
    for (Eigen::Index k = 0; k < contact.quadraturePressure.size(); ++k)
      if (const double radius = contact.quadraturePoints(0, k); radius > inside)
        outside = std::min(outside, radius);
    if (inside > 0.0 && std::isfinite(outside))
      return Radius{0.5 * (inside + outside), kOff * (outside - inside)};
  }
  return std::nullopt;
}

/// From the last row of a hold at the largest depth or force to where the force grows again, or ends.
IndentationCurve unloadingOf(const IndentationCurve& curve, std::size_t largest) {
  constexpr double kSame = 1e-9;
  const auto holds = [&](std::size_t k) {
    return curve.depths[k] >= curve.depths[largest] - kSame * std::abs(curve.depths[largest]) ||
           curve.forces[k] >= curve.forces[largest] * (1.0 - kSame);
  };
  std::size_t begin = largest;
  while (begin + 1 < curve.forces.size() && holds(begin + 1)) ++begin;
  std::size_t end = begin + 1;
  while (end < curve.forces.size() && curve.forces[end] > 0.0 && curve.forces[end] <= curve.forces[end - 1])
    ++end;
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(begin),
                               all.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {part(curve.depths), part(curve.forces)};
}

/// What is missing of an unloading of which a part of its first force is the end of the fit; empty for nothing.
std::string shortUnloading(const IndentationCurve& curve, std::size_t largest,
                           const IndentationCurve& unloading, double fitEnd) {
  const double last = unloading.forces.back(), left = last / unloading.forces.front();
  const auto next =
      std::find(curve.forces.begin() + static_cast<std::ptrdiff_t>(largest), curve.forces.end(), last) + 1;
  if (left <= fitEnd || (next != curve.forces.end() && *next <= 0.0)) return {};
  return fmt::format(
      "{} at {:.3g} of the first force of the unloading, before the fit from {:.3g} on is reached",
      next == curve.forces.end() ? "the run ends" : "the force grows again", left, fitEnd);
}

std::optional<int> frameAt(const ResultReader& result, double time) {
  const std::vector<double> times = result.times();
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - time) <= 1e-9 * std::max(1.0, std::abs(time))) return static_cast<int>(k);
  return std::nullopt;
}

}  // namespace

Indentation indentationOf(const ResultReader& result, const IndentationSpec& spec) {
  if (!isAxisymmetric(result.model()))
    throw Error(
        "the body is not one of revolution (kinematics: axisymmetric), for which indentations are evaluated");
  const Scene scene = parseScene(result.model().sceneYaml, result.file().string());
  const ToolSpec& tool = toolOf(scene, spec.tool);
  const Placed placed = placedOf(tool);
  if (placed.tip.x() != 0.0)
    throw Error(fmt::format("tool: the tip of {} is at x = {:.6g}; expected one on the axis, at 0",
                            quoted(tool.name), placed.tip.x()));
  const Elastic elastic = elasticOf(scene.allBodies().front().material);
  if (!spec.nu && !elastic.nu) throw Error("nu: the law of the scene has none; expected it as an option");

  Indentation found;
  found.indenter = placed.indenter;
  found.nu = spec.nu.value_or(elastic.nu.value_or(0.0));
  found.beta = spec.beta.value_or(usualBeta(placed.indenter, found.nu));
  found.sceneModulus = elastic.E;
  const HistoryTable history = readHistory(result.file().parent_path() / "history.csv");
  const std::vector<double>&ways = history.column(tool.name + ".uy"),
        &forces = history.column(tool.name + ".fy");
  const double gap = placed.tip.y() - highestPointOf(result.model());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    found.curve.depths.push_back(-gap - ways[k]);
    found.curve.forces.push_back(std::abs(forces[k]));
  }
  found.largest = static_cast<std::size_t>(
      std::max_element(found.curve.forces.begin(), found.curve.forces.end()) - found.curve.forces.begin());
  if (found.curve.forces.empty() || found.curve.forces[found.largest] == 0.0)
    throw Error(fmt::format("tool: {} exerts no force in this run", quoted(tool.name)));
  const IndentationCurve unloading = unloadingOf(found.curve, found.largest);
  found.found = oliverPharr(unloading, placed.indenter, {spec.fit[0], spec.fit[1], spec.epsilon, found.beta});
  found.modulus = (1.0 - found.nu * found.nu) * found.found.modulus;
  found.shortUnloading = shortUnloading(found.curve, found.largest, unloading, spec.fit[0]);

  const double time = history.column("time")[found.largest];
  const auto frame = frameAt(result, time);
  if (findColumn(history, tool.name + ".contact_area") == nullptr)
    found.noArea = "method integral-augmented-lagrangian alone knows pressures at points";
  else if (!frame)
    found.noArea = fmt::format("there is no frame at t = {:.6g}, where the force is largest", time);
  if (!found.noArea.empty()) return found;
  if (const auto radius = contactRadius(result.frame(*frame), tool.name)) {
    const double area = std::numbers::pi * radius->value * radius->value;
    const ModulusAndHardness with = withArea(found.found, area, found.beta);
    found.computed = {area, 2.0 * area * radius->uncertainty / radius->value,
                      (1.0 - found.nu * found.nu) * with.modulus, with.hardness};
  }
  return found;
}

}  // namespace burnish
