#include "engine/analysis/check_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "engine/analysis/nearest_point.h"
#include "engine/analysis/time_grid.h"
#include "engine/core/input_error.h"

namespace burnish::inline analysis {
namespace {

constexpr std::array kComponentNames{"x", "y", "z"};

/// Gathers a formula in t alone that has no finite value at one of the times.
void gatherInfinite(const std::string& key, const FormulaText& formula, const Scene& scene,
                    const std::vector<double>& times, InputProblems& problems) {
  problems.gather([&] {
    placed(key, [&] {
      requireFinite({Formula(formula, scene.definitions)}, Eigen::Matrix3Xd::Zero(3, 1), times);
    });
  });
}

/// The same of all formulas of a motion or load of tools.
template <class Spec>
void gatherInfinite(const std::string& path, const Spec& spec, const std::optional<FormulaText>& turn,
                    const char* turnKey, const Scene& scene, const std::vector<double>& times,
                    InputProblems& problems) {
  const std::array<std::pair<const char*, const std::optional<FormulaText>*>, kToolDofs> dofs{
      {{"x", &spec.x}, {"y", &spec.y}, {"z", &spec.z}, {turnKey, &turn}}};
  for (const auto& dof : dofs)
    if (*dof.second)
      gatherInfinite(fmt::format("{}.{}", path, dof.first), **dof.second, scene, times, problems);
}

/// Rigid motions of a body that its supports leave free.
struct FreeMotions {
  int count = 0;
  std::vector<std::string> names;  ///< "x", "y", "its turn"
};

/// Rigid motions of a reference body, displacement components of its nodes x motions: first the translations.
template <int Dim>
Eigen::MatrixXd rigidMotions(const Body<Dim>& body) {
  const int numRigid = body.axisymmetric ? 1 : Dim == 2 ? 3 : 6;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(Dim * body.numNodes, numRigid);
  const Eigen::MatrixXd positions = body.nodePositions() / body.size();
  for (int a = 0; a < body.numNodes; ++a) {
    if (body.axisymmetric) {
      motions(Dim * a + 1, 0) = 1.0;
      continue;
    }
    for (int d = 0; d < Dim; ++d) motions(Dim * a + d, d) = 1.0;
    int column = Dim;
    for (int i = 0; i < Dim; ++i)
      for (int j = i + 1; j < Dim; ++j, ++column) {
        motions(Dim * a + i, column) = -positions(j, a);
        motions(Dim * a + j, column) = positions(i, a);
      }
  }
  return motions;
}

/// The supports hold a body if the values of its rigid motions at the unknowns that they prescribe are linearly
/// independent. time: behind which.
template <int Dim>
FreeMotions freeMotions(const Model<Dim>& model, const ModelBody<Dim>& body, double time) {
  constexpr double kRounding = 1e-10;
  const Eigen::MatrixXd motions = rigidMotions(body.body);
  const auto [first, end] = body.body.nodeRange();
  std::vector<int> held;
  for (int i = Dim * first; i < Dim * end; ++i)
    if (model.supports().holdsBehind(time, i)) held.push_back(i);
  const Eigen::MatrixXd atSupports = motions(held, Eigen::all);
  const auto rankOf = [&](const Eigen::MatrixXd& values) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(values);
    qr.setThreshold(kRounding);
    return held.empty() ? 0 : static_cast<int>(qr.rank());
  };
  FreeMotions free;
  free.count = static_cast<int>(motions.cols()) - rankOf(atSupports);
  // A translation is free where it moves nothing that is held.
  const int translations = body.body.axisymmetric ? 1 : Dim;
  for (int d = 0; d < translations; ++d)
    if (held.empty() || atSupports.col(d).isZero(kRounding))
      free.names.emplace_back(body.body.axisymmetric ? "y" : kComponentNames[static_cast<std::size_t>(d)]);
  if (const int turns = free.count - static_cast<int>(free.names.size()); turns > 0)
    free.names.push_back(turns == 1 ? "a turn" : fmt::format("{} turns", turns));
  return free;
}

/// Whether a body has a face in contact.
template <int Dim>
bool touches(const Model<Dim>& model, const ModelBody<Dim>& body) {
  const auto isOf = [&](const FacePlace& place) { return &model.bodyOf(place) == &body; };
  return std::any_of(model.pairs().begin(), model.pairs().end(),
                     [&](const FacePair<Dim>& pair) {
                       return isOf(pair.place) || std::any_of(pair.against.begin(), pair.against.end(), isOf);
                     }) ||
         std::any_of(model.contacts().begin(), model.contacts().end(),
                     [&](const ContactPair<Dim>& pair) { return isOf(pair.place); });
}

}  // namespace

std::string loadKey(const Scene& scene, std::size_t number) {
  const LoadSpec& load = scene.loads[number];
  return fmt::format("loads[{}].{}", number,
                     !load.bodyForce.empty()  ? "body_force"
                     : !load.traction.empty() ? "traction"
                     : load.pressure          ? "pressure"
                                              : "shear");
}

template <int Dim>
void requireFiniteFormulas(const Scene& scene, const Model<Dim>& model) {
  std::vector<double> times{0.0};
  for (const TimePoint& point : timeGrid(scene, model.corners())) times.push_back(point.time);
  InputProblems problems;
  problems.gather([&] { model.supports().requireFinite(times); });
  for (std::size_t k = 0; k < model.loads().size(); ++k)
    problems.gather([&] { placed(loadKey(scene, k), [&] { model.loads()[k]->requireFinite(times); }); });
  for (std::size_t k = 0; k < scene.tools.size(); ++k) {
    const ToolSpec& tool = scene.tools[k];
    const std::string path = fmt::format("tools[{}]", k);
    if (const auto& p = tool.prescribe)
      gatherInfinite(path + ".prescribe", *p, p->angle, "angle", scene, times, problems);
    if (const auto& c = tool.carry) {
      gatherInfinite(path + ".carry", *c, c->moment, "moment", scene, times, problems);
      if (c->normal) gatherInfinite(path + ".carry.normal", *c->normal, scene, times, problems);
    }
  }
  problems.throwIfAny();
}

template <int Dim>
void requireApart(const Model<Dim>& model, double overlap, const ContactSpec& spec,
                  const std::string& place) {
  if (overlap <= kTouching * model.body().size()) return;
  throw InputError(
      place,
      fmt::format("face '{}' overlaps face '{}' by {:.3g} at the start; move the bodies apart by at least "
                  "that much (touching is fine), or fit them into one another with interference: resolve",
                  spec.place.face, spec.against.front().face, overlap));
}

/// Of a tool that overlaps a face: what would move it away. A path has it come down from its clearance.
std::string apartText(const ToolSpec& tool) {
  return tool.path
             ? "its path begins there: a clearance that is larger by that much has it come down from outside"
             : "move it away by at least that much (touching is fine)";
}

template <int Dim>
void requireReachable(const Scene& scene, const Model<Dim>& model, const ContactSpec& spec,
                      const std::string& place) {
  const Tool& tool = *model.tools()[model.toolNumber(spec.tool)];
  const FaceFinder<Dim>& faces = model.faces();
  faces.requireOuter(spec.place, place);
  const NearestPoint nearest = nearestPoint(model.body(), faces.face(spec.place), tool, 0.0);
  const double touching = kTouching * std::min(tool.shape.halfThickness(), model.body().size());
  if (-nearest.gap > touching + tool.shape.bulge())
    throw InputError(place, fmt::format("tool '{}' overlaps face '{}' by {:.3g} at the start; {}", spec.tool,
                                        spec.place.face, -nearest.gap,
                                        apartText(scene.tools[model.toolNumber(spec.tool)])));
  if (nearest.facing > 0.5)
    throw InputError(place, fmt::format("tool '{}' is behind face '{}' at the start, inside the body or on "
                                        "its other side; put it in front of the face",
                                        spec.tool, spec.place.face));
  const auto nodes = faces.nodes(spec.place);
  const bool held = std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    const auto first = model.prescribed().begin() + Dim * node;
    return std::all_of(first, first + Dim, [](bool flag) { return flag; });
  });
  if (held)
    throw InputError(
        place,
        fmt::format(
            "face '{}' is held in all its components, so tool '{}' cannot move it; name a face that is free",
            spec.place.face, spec.tool));
}

template <int Dim>
void requireSupported(const Scene& scene, const Model<Dim>& model) {
  InputProblems problems;
  const auto require = [&](const ModelBody<Dim>& body, double time, const std::string& key,
                           const std::string& when) {
    const FreeMotions free = freeMotions(model, body, time);
    if (free.count == 0) return;
    if (body.name.empty())
      throw InputError(
          key, fmt::format("{} leave the body free to move as a rigid whole in {} way{}{}; hold "
                           "more components or faces{}",
                           when.empty() ? "they" : "the supports", free.count, free.count == 1 ? "" : "s",
                           when, when.empty() ? "" : ", for instance single points (part: [0, 0])"));
    throw InputError(
        key, fmt::format("body '{}': nothing holds it in {}{}; hold more of its components or faces{}",
                         body.name, fmt::join(free.names, ", "), when,
                         touches(model, body) ? ", or let stabilise hold it until contact does" : ""));
  };
  for (const ModelBody<Dim>& body : model.bodies())
    problems.gather([&] { require(body, 0.0, "supports", ""); });
  problems.throwIfAny();
  for (std::size_t k = 0; k < scene.supports.size(); ++k)
    if (const auto& until = scene.supports[k].until)
      for (const ModelBody<Dim>& body : model.bodies())
        problems.gather([&] {
          require(body, *until, fmt::format("supports[{}].until", k),
                  fmt::format(" behind t = {:.6g}", *until));
        });
  problems.throwIfAny();
}

template <int Dim>
void requireHeldAxis(const Model<Dim>& model) {
  const Body<Dim>& body = model.body();
  if (!body.axisymmetric) return;
  constexpr double kRounding = 1e-10, kForever = 1e300;
  const Eigen::MatrixXd positions = body.nodePositions();
  for (const OuterFace& face : model.faces().outerFaces()) {
    const auto patch = static_cast<std::size_t>(face.place.patch);
    bool liesThere = true, isHeld = true;
    for (const int a : faceFunctions(body.patches[patch].basis(), face.place.face)) {
      const int node = body.nodes[patch][static_cast<std::size_t>(a)];
      liesThere = liesThere && std::abs(positions(0, node)) <= kRounding * body.size();
      isHeld = isHeld && model.supports().holdsBehind(kForever, Dim * node);
    }
    if (liesThere && !isHeld)
      throw InputError(
          "supports",
          fmt::format("face {} lies on the axis of revolution, and nothing keeps it there: a hole would "
                      "open; add a support of this face with symmetry: true",
                      face.text));
  }
}

template void requireFiniteFormulas(const Scene&, const Model<2>&);
template void requireFiniteFormulas(const Scene&, const Model<3>&);
template void requireApart(const Model<2>&, double, const ContactSpec&, const std::string&);
template void requireApart(const Model<3>&, double, const ContactSpec&, const std::string&);
template void requireReachable(const Scene&, const Model<2>&, const ContactSpec&, const std::string&);
template void requireReachable(const Scene&, const Model<3>&, const ContactSpec&, const std::string&);
template void requireSupported(const Scene&, const Model<2>&);
template void requireSupported(const Scene&, const Model<3>&);
template void requireHeldAxis(const Model<2>&);
template void requireHeldAxis(const Model<3>&);

}  // namespace burnish::inline analysis
