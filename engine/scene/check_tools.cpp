#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/nurbs/knot_vector.h"
#include "engine/scene/check_context.h"
#include "engine/scene/check_motion.h"
#include "engine/scene/schema_tools.h"

namespace burnish {
namespace {

bool isZero(const std::vector<double>& vector) {
  return std::all_of(vector.begin(), vector.end(), [](double v) { return v == 0.0; });
}

void checkAxis(const CheckContext& c, const std::string& path, const std::vector<double>& axis) {
  if (!c.clean(path)) return;
  if (isZero(axis))
    c.report(path, fmt::format("found [{}]; allowed: a direction.", fmt::join(axis, ", ")));
  else if (c.dimensionIsKnown() && c.scene.dim() == 2 && (axis[0] != 0.0 || axis[1] != 0.0))
    c.report(path, fmt::format("found [{}]; allowed in two dimensions: [0, 0, 1].", fmt::join(axis, ", ")));
}

/// Whether bodies of this kinematics and dimension may have tools of a shape.
bool fits(const Scene& scene, const std::string& shape) {
  if (shape == "polyline") return scene.dim() == 2;
  if (shape == "cone") return scene.dim() == 3 || scene.kinematics == KinematicsChoice::Axisymmetric;
  return scene.dim() == 3 || (shape != "sphere" && shape != "torus" && shape != "mesh");
}

/// A shape, of those that there are at `path`, that the dimension has.
template <class Shapes>
void checkDimension(const CheckContext& c, const std::string& path, const Shapes& shapes, std::size_t index) {
  const std::string& found = shapes[index].name;
  if (!c.clean(path + ".shape") || !c.dimensionIsKnown() || fits(c.scene, found)) return;
  std::vector<std::string> allowed;
  for (const Alternative& shape : shapes)
    if (fits(c.scene, shape.name)) allowed.push_back(shape.name);
  c.report(path + ".shape", fmt::format("found {}, which needs a {} body; allowed here: {}.", found,
                                        found == "polyline" ? "two-dimensional"
                                        : found == "cone"   ? "three-dimensional or axisymmetric"
                                                            : "three-dimensional",
                                        fmt::join(allowed, " | ")));
}

/// Checks of one shape, whose keys are at `path`.
class ShapeCheck {
 public:
  ShapeCheck(const CheckContext& c, std::string path) : c_(c), path_(std::move(path)) {}

  void operator()(const PlaneToolSpec& plane) const {
    if (clean("normal") && isZero(plane.normal))
      report("normal", "found a vector without length; allowed: a direction from the tool towards the body.");
  }
  void operator()(const CylinderToolSpec& cylinder) const { checkAxis(c_, key("axis"), cylinder.axis); }
  void operator()(const SphereToolSpec&) const {}
  void operator()(const EdgeToolSpec& edge) const;
  void operator()(const ConeToolSpec& cone) const;
  void operator()(const TorusToolSpec& torus) const;
  void operator()(const BoxToolSpec& box) const;
  void operator()(const NurbsToolSpec& nurbs) const;
  void operator()(const PolylineToolSpec& line) const;
  void operator()(const MeshToolSpec&) const {}
  void operator()(const UnionToolSpec& joined) const;

 private:
  std::string key(const char* name) const { return fmt::format("{}.{}", path_, name); }
  bool clean(const char* name) const { return c_.clean(key("shape")) && c_.clean(key(name)); }
  void report(const std::string& name, const std::string& problem) const {
    c_.report(fmt::format("{}.{}", path_, name), problem);
  }
  bool isPlanar() const { return c_.dimensionIsKnown() && c_.scene.dim() == 2; }
  bool isSpatial() const { return c_.dimensionIsKnown() && c_.scene.dim() == 3; }
  bool isAxisymmetric() const { return c_.scene.kinematics == KinematicsChoice::Axisymmetric; }

  void requireDirection(const char* name, const std::vector<double>& direction) const {
    if (clean(name) && isZero(direction))
      report(name, "found a vector without length; allowed: a direction from the tool to the front.");
  }
  void checkPoints(const std::vector<std::vector<double>>& points, std::size_t dim) const;

  const CheckContext& c_;
  std::string path_;
};

bool areParallel(const std::vector<double>& a, const std::vector<double>& b) {
  Eigen::Vector3d u = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  std::copy(a.begin(), a.end(), u.begin());
  std::copy(b.begin(), b.end(), v.begin());
  return u.cross(v).norm() <= 1e-9 * u.norm() * v.norm();
}

void ShapeCheck::operator()(const EdgeToolSpec& edge) const {
  requireDirection("direction", edge.direction);
  checkAxis(c_, key("along"), edge.along);
  if (isSpatial() && clean("direction") && clean("along") && edge.direction.size() == 3 &&
      areParallel(edge.direction, edge.along))
    report("along", fmt::format("found [{}], parallel to direction; allowed: a direction across it.",
                                fmt::join(edge.along, ", ")));
}

void ShapeCheck::operator()(const ConeToolSpec& cone) const {
  requireDirection("direction", cone.direction);
  if (!isAxisymmetric()) return;
  if (clean("direction") && cone.direction.size() == 2 && cone.direction[0] != 0.0)
    report("direction", fmt::format("found [{}]; allowed in axisymmetry: a direction along the axis y.",
                                    fmt::join(cone.direction, ", ")));
  if (clean("tip") && cone.tip.size() == 2 && cone.tip[0] != 0.0)
    report("tip", fmt::format("found [{}]; allowed in axisymmetry: a point of the axis, x = 0.",
                              fmt::join(cone.tip, ", ")));
}

void ShapeCheck::operator()(const TorusToolSpec& torus) const {
  checkAxis(c_, key("axis"), torus.axis);
  if (clean("radius") && clean("tube_radius") && torus.tubeRadius >= torus.radius)
    report("tube_radius",
           fmt::format("found {}; allowed: a number below the radius {}.", torus.tubeRadius, torus.radius));
}

void ShapeCheck::operator()(const BoxToolSpec& box) const {
  if (clean("size") && clean("radius")) {
    const double smallest = *std::min_element(box.size.begin(), box.size.end());
    if (2.0 * box.radius > smallest)
      report("radius", fmt::format("found {}; allowed: at most {}, half the smallest size.", box.radius,
                                   0.5 * smallest));
  }
  if (box.axes.empty() || !clean("axes") || !c_.dimensionIsKnown()) return;
  const auto dim = static_cast<std::size_t>(c_.scene.dim());
  const bool fits = box.axes.size() == dim - 1 &&
                    std::all_of(box.axes.begin(), box.axes.end(),
                                [&](const auto& axis) { return axis.size() == dim && !isZero(axis); });
  if (!fits)
    report("axes", dim == 2 ? "found something else than one direction; allowed: [[x, y]]."
                            : "found something else than two directions; allowed: [[x, y, z], [x, y, z]].");
  else if (dim == 3 && areParallel(box.axes[0], box.axes[1]))
    report("axes", "found two parallel directions; allowed: two directions across one another.");
}

void ShapeCheck::checkPoints(const std::vector<std::vector<double>>& points, std::size_t dim) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].size() != dim)
      report(fmt::format("points[{}]", i),
             fmt::format("found {} coordinates; allowed: {}, one per dimension of the body.",
                         points[i].size(), dim));
}

void ShapeCheck::operator()(const NurbsToolSpec& nurbs) const {
  if (!clean("degrees") || !clean("knots") || !clean("points") || !c_.dimensionIsKnown()) return;
  const auto dim = static_cast<std::size_t>(c_.scene.dim());
  if (nurbs.degrees.size() != dim - 1)
    return report("degrees", fmt::format("found {} degrees; allowed: {}.", nurbs.degrees.size(),
                                         dim == 2 ? "1, that of a curve" : "2, those of a surface"));
  if (nurbs.knots.size() != nurbs.degrees.size())
    return report("knots", fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                       nurbs.knots.size(), nurbs.degrees.size()));
  std::size_t functions = 1;
  for (std::size_t d = 0; d < nurbs.knots.size(); ++d) {
    try {
      functions *= static_cast<std::size_t>(KnotVector(nurbs.degrees[d], nurbs.knots[d]).numFunctions());
    } catch (const Error& problem) {
      return report(fmt::format("knots[{}]", d), fmt::format("{}.", problem.what()));
    }
  }
  checkPoints(nurbs.points, dim);
  if (nurbs.points.size() != functions)
    report("points", fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                                 nurbs.points.size(), functions));
  if (!nurbs.weights.empty() && nurbs.weights.size() != nurbs.points.size() && clean("weights"))
    report("weights", fmt::format("found {} weights for {} points; allowed: one per control point.",
                                  nurbs.weights.size(), nurbs.points.size()));
}

void ShapeCheck::operator()(const PolylineToolSpec& line) const {
  if (!clean("file") || !clean("points")) return;
  if (line.file.empty() == line.points.empty())
    c_.report(path_, fmt::format("found {}; allowed: exactly one of points and file.",
                                 line.file.empty() ? "neither points nor file" : "points and file"));
  if (isPlanar()) checkPoints(line.points, 2);
  if (line.closed && !line.points.empty() && line.points.size() < 3)
    report("points",
           fmt::format("found {} points of a closed line; allowed: at least 3.", line.points.size()));
}

void ShapeCheck::operator()(const UnionToolSpec& joined) const {
  for (std::size_t i = 0; i < joined.parts.size(); ++i)
    if (const std::string part = fmt::format("{}.parts[{}]", path_, i); c_.clean(part + ".shape")) {
      checkDimension(c_, part, toolPartShapes(), joined.parts[i].shape.index());
      std::visit(ShapeCheck(c_, part), joined.parts[i].shape);
    }
}

/// The ways in which a tool moves or carries a load: the three displacements and the turn, by key.
template <class Spec, class T>
Components<T> waysOf(const Spec& s, const char* turnKey, const std::optional<T>& turn) {
  auto ways = componentsOf(s);
  ways.emplace_back(turnKey, &turn);
  return ways;
}

/// In axisymmetry a tool moves along the axis alone. across, around: what the other ways are called.
template <class T>
void checkAlongAxis(const CheckContext& c, const std::string& path, const Components<T>& ways,
                    const char* across, const char* around) {
  if (c.scene.kinematics != KinematicsChoice::Axisymmetric) return;
  for (const auto& [key, way] : ways)
    if (*way && std::string(key) != "y" && c.clean(fmt::format("{}.{}", path, key)))
      c.report(fmt::format("{}.{}", path, key), fmt::format("found a {}; allowed in axisymmetry: y alone.",
                                                            std::string(key) == "x" ? across : around));
}

constexpr const char* kAcross = "motion across the axis of revolution";
constexpr const char* kTurning = "turn";

void checkMotion(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (tool.motion) {
    const auto ways = waysOf(*tool.motion, "angle", tool.motion->angle);
    checkTable(c, path + ".motion", tool.motion->times, ways);
    checkAlongAxis(c, path + ".motion", ways, kAcross, kTurning);
  }
  if (tool.prescribe) {
    const auto ways = waysOf(*tool.prescribe, "angle", tool.prescribe->angle);
    checkFormulas(c, path + ".prescribe", ways, checkTimeFormula);
    checkAlongAxis(c, path + ".prescribe", ways, kAcross, kTurning);
  }
  if (tool.motion && tool.prescribe && c.clean(path + ".prescribe"))
    c.report(path + ".prescribe", "found beside motion; allowed: one of motion and prescribe.");
}

/// Whether a component of a prescribed motion is given, by the place of its key in x, y, z, turn.
template <class Motion>
bool isGiven(const std::optional<Motion>& motion, std::size_t way) {
  return motion && waysOf(*motion, "angle", motion->angle)[way].second->has_value();
}

void checkCarry(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (!tool.carry) return;
  const std::string place = path + ".carry";
  const auto ways = waysOf(*tool.carry, "moment", tool.carry->moment);
  checkFormulas(c, place, ways, checkTimeFormula);
  checkAlongAxis(c, place, ways, "force across the axis of revolution", "moment");
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const std::string key = fmt::format("{}.{}", place, ways[k].first);
    if (ways[k].second->has_value() && c.clean(key) &&
        (isGiven(tool.motion, k) || isGiven(tool.prescribe, k)))
      c.report(key, "found although the motion in this way is prescribed; allowed: one of the two.");
  }
  if (tool.carry->schedule && c.clean(place + ".schedule"))
    checkSchedule(c, place + ".schedule", *tool.carry->schedule);
}

void checkTool(const CheckContext& c, const std::string& path, const ToolSpec& tool) {
  if (c.clean(path + ".shape")) {
    checkDimension(c, path, toolShapes(), tool.shape.index());
    std::visit(ShapeCheck(c, path), tool.shape);
  }
  checkAxis(c, path + ".pivot_axis", tool.pivotAxis);
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
