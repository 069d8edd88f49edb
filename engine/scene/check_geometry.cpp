#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/core/error.h"
#include "engine/scene/check_context.h"
#include "engine/scene/dimension.h"
#include "engine/scene/mesh_knots.h"

namespace burnish {
namespace {

/// Beyond this number of basis functions a direct solver does not fit any machine; the indices of its matrix
/// would overflow a little later.
constexpr double kMostFunctions = 500'000;

/// Checks of one patch, whose keys are at `at`.
class PatchCheck {
 public:
  PatchCheck(const CheckContext& c, std::string at, const MeshSpec& mesh)
      : c_(c), at_(std::move(at)), mesh_(mesh) {}

  void operator()(const RectangleSpec&) { checkNamed({1, 1}); }
  void operator()(const BoxSpec&) { checkNamed({1, 1, 1}); }
  void operator()(const AnnulusSpec& ring);
  void operator()(const DiscSpec& disc);
  void operator()(const EllipseSpec& ellipse);
  void operator()(const TubeSpec& tube);
  void operator()(const CylinderSpec& cylinder);
  void operator()(const BallOctantSpec& ball);
  void operator()(const ControlNetSpec& net);
  void operator()(const PatchesSpec&) {}

  /// Number of basis functions as far as it is known.
  double functions() const { return functions_; }

 private:
  std::string key(const char* name) const { return fmt::format("{}.{}", at_, name); }
  bool clean(const char* name) const { return c_.clean(key(name)); }
  void report(const char* name, const std::string& problem) const { c_.report(key(name), problem); }
  void reportEntry(const char* name, std::size_t entry, const std::string& problem) const {
    c_.report(fmt::format("{}.{}[{}]", at_, name, entry), problem);
  }

  void checkRadii(double inner, double outer) const;
  void checkOpening(double angle, const char* shape) const;
  void checkDirection(const char* name, const std::vector<double>& direction) const;
  void checkArcDegree(const char* shape) const;
  void checkNamed(const std::vector<int>& degrees);
  void checkNumberOfFunctions(std::size_t direction) const;
  std::optional<std::vector<KnotVector>> netKnots(const ControlNetSpec& net) const;
  void checkPoints(const ControlNetSpec& net, const std::vector<KnotVector>& knots) const;
  void checkCreases() const;
  void checkMesh(const std::vector<KnotVector>& shape);

  const CheckContext& c_;
  std::string at_;
  const MeshSpec& mesh_;
  double functions_ = 0.0;
};

void PatchCheck::operator()(const AnnulusSpec& ring) {
  checkRadii(ring.innerRadius, ring.outerRadius);
  checkArcDegree("an annulus");
  checkNamed({1, 2});
}

void PatchCheck::operator()(const DiscSpec& disc) {
  checkOpening(disc.openingAngle, "disc");
  checkArcDegree("a disc");
  checkNamed({2, 2});
}

void PatchCheck::operator()(const EllipseSpec&) {
  checkArcDegree("an ellipse");
  checkNamed({2, 2});
}

void PatchCheck::operator()(const TubeSpec& tube) {
  checkRadii(tube.innerRadius, tube.outerRadius);
  checkDirection("axis", tube.axis);
  checkArcDegree("a tube");
  checkNamed({1, 2, 1});
}

void PatchCheck::operator()(const CylinderSpec& cylinder) {
  checkOpening(cylinder.openingAngle, "cylinder");
  checkDirection("axis", cylinder.axis);
  checkArcDegree("a cylinder");
  checkNamed({2, 2, 1});
}

void PatchCheck::operator()(const BallOctantSpec& ball) {
  checkDirection("pole", ball.pole);
  checkArcDegree("a ball");
  checkNamed({1, 2, 2});
}

void PatchCheck::checkRadii(double inner, double outer) const {
  if (clean("inner_radius") && clean("outer_radius") && outer <= inner)
    report("outer_radius",
           fmt::format("found {}; allowed: a number above the inner radius {}.", outer, inner));
}

void PatchCheck::checkOpening(double angle, const char* shape) const {
  if (clean("opening_angle") && angle >= 180.0 && angle != 360.0)
    report("opening_angle",
           fmt::format("found {}; allowed: a number above 0 and below 180, or 360 for the whole {}.", angle,
                       shape));
}

void PatchCheck::checkDirection(const char* name, const std::vector<double>& direction) const {
  if (clean(name) && std::all_of(direction.begin(), direction.end(), [](double d) { return d == 0.0; }))
    report(name, "found a vector of length 0; allowed: a direction, such as [0, 0, 1].");
}

void PatchCheck::checkArcDegree(const char* shape) const {
  if (c_.scene.basis == BasisChoice::Nurbs && c_.scene.degree < 2 && c_.clean("degree"))
    c_.report(
        "degree",
        fmt::format(
            "found {}; allowed for {} in NURBS: at least 2, a circular arc is a rational curve of degree 2.",
            c_.scene.degree, shape));
}

void PatchCheck::checkNumberOfFunctions(std::size_t direction) const {
  const int p = c_.scene.degree;
  const int n = mesh_.functions[direction];
  if (n < p + 1)
    return reportEntry("functions", direction,
                       fmt::format("found {}; allowed: at least {}, the degree plus one.", n, p + 1));
  if (c_.scene.basis == BasisChoice::Lagrange && (n - 1) % p != 0) {
    const int elements = (n - 1) / p;
    reportEntry("functions", direction,
                fmt::format("found {}; allowed for Lagrange elements of degree {}: a multiple of {} plus "
                            "one, such as {} or {}.",
                            n, p, p, elements * p + 1, (elements + 1) * p + 1));
  }
}

/// Shapes of one knot span per direction, with the degrees that describe them exactly.
void PatchCheck::checkNamed(const std::vector<int>& degrees) {
  if (clean("functions") && clean("spans")) {
    if (mesh_.functions.empty() && mesh_.spans.empty())
      c_.report(at_,
                "found neither functions nor spans; allowed: exactly one of the two, such as spans: [8, 4].");
    if (!mesh_.functions.empty() && !mesh_.spans.empty())
      report("spans", "found spans beside functions; allowed: one of the two.");
  }
  if (!mesh_.refine.empty() && clean("refine"))
    report("refine", "found refine, which divides the knot spans of a control net; allowed: spans.");
  if (!mesh_.functions.empty() && !mesh_.creases.empty() && clean("functions"))
    report("functions", "found functions beside creases, which add functions; allowed: spans.");
  if (clean("functions") && c_.clean("degree") && c_.clean("basis"))
    for (std::size_t d = 0; d < mesh_.functions.size(); ++d) checkNumberOfFunctions(d);
  std::vector<KnotVector> shape;
  for (const int degree : degrees) shape.push_back(KnotVector::uniform(degree, 1));
  checkMesh(shape);
}

void PatchCheck::operator()(const ControlNetSpec& net) {
  for (const auto& [name, given] :
       {std::pair{"functions", &mesh_.functions}, std::pair{"spans", &mesh_.spans}})
    if (!given->empty() && clean(name))
      report(name, fmt::format("found {}, but a control net brings its own knots; allowed: refine.", name));
  if (net.degrees.empty() || !clean("degrees")) return;
  if (const auto knots = netKnots(net)) {
    checkPoints(net, *knots);
    checkMesh(*knots);
  }
  if (!net.weights.empty() && net.weights.size() != net.points.size() && clean("points") && clean("weights"))
    report("weights", fmt::format("found {} weights for {} points; allowed: one per control point.",
                                  net.weights.size(), net.points.size()));
}

/// Nothing when a knot vector is unusable, which is reported.
std::optional<std::vector<KnotVector>> PatchCheck::netKnots(const ControlNetSpec& net) const {
  if (!clean("knots")) return std::nullopt;
  if (net.knots.size() != net.degrees.size()) {
    report("knots", fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                net.knots.size(), net.degrees.size()));
    return std::nullopt;
  }
  std::vector<KnotVector> knots;
  for (std::size_t d = 0; d < net.knots.size(); ++d) {
    try {
      knots.emplace_back(net.degrees[d], net.knots[d]);
    } catch (const Error& e) {
      reportEntry("knots", d, fmt::format("{}.", e.what()));
    }
  }
  if (knots.size() < net.knots.size()) return std::nullopt;
  return knots;
}

void PatchCheck::checkPoints(const ControlNetSpec& net, const std::vector<KnotVector>& knots) const {
  if (!clean("points")) return;
  const std::size_t dim = net.degrees.size();
  for (std::size_t i = 0; i < net.points.size(); ++i)
    if (net.points[i].size() != dim)
      reportEntry("points", i,
                  fmt::format("found {} coordinates; allowed: {}, one per direction of the body.",
                              net.points[i].size(), dim));
  const auto functions = std::accumulate(
      knots.begin(), knots.end(), std::size_t{1},
      [](std::size_t n, const KnotVector& k) { return n * static_cast<std::size_t>(k.numFunctions()); });
  if (net.points.size() != functions)
    report("points", fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                                 net.points.size(), functions));
}

void PatchCheck::checkCreases() const {
  for (std::size_t d = 0; d < mesh_.creases.size(); ++d)
    for (std::size_t k = 0; k < mesh_.creases[d].size(); ++k)
      if (const double s = mesh_.creases[d][k]; s < 0.0 || s > 1.0)
        c_.report(fmt::format("{}.creases[{}][{}]", at_, d, k),
                  fmt::format("found {}; allowed: a number from 0 to 1.", s));
}

/// `shape`: the knots of the shape in each direction.
void PatchCheck::checkMesh(const std::vector<KnotVector>& shape) {
  if (clean("creases")) checkCreases();
  for (const char* name : {"functions", "spans", "refine", "grading", "creases"})
    if (!clean(name)) return;
  if (!c_.clean(at_) || !c_.clean("degree") || !c_.clean("basis") || !c_.clean("definitions")) return;
  functions_ = 1.0;
  for (std::size_t d = 0; d < shape.size(); ++d)
    functions_ *= static_cast<double>(shape[d].numSpans()) * partsOf(c_.scene, mesh_, d);
  if (functions_ > kMostFunctions) return;
  functions_ = 1.0;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    try {
      functions_ *= numFunctions(c_.scene, meshKnots(c_.scene, mesh_, d, shape[d]));
    } catch (const Error& problem) {
      reportEntry("grading", d, fmt::format("{}.", problem.what()));
    }
  }
}

void checkPatchNames(const CheckContext& c, const std::vector<PatchSpec>& patches) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::string path = fmt::format("geometry.patches[{}].name", i);
    const auto same = std::find_if(patches.begin(), patches.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const PatchSpec& other) { return other.name == patches[i].name; });
    if (c.clean(path) && same != patches.begin() + static_cast<std::ptrdiff_t>(i))
      c.report(path,
               fmt::format("found {}, the name of another patch; allowed: a name of its own for each patch.",
                           patches[i].name));
  }
}

/// With several patches, keys of the mesh stand in each of them.
void checkNoCommonMesh(const CheckContext& c) {
  const MeshSpec& mesh = c.scene.geometry.mesh;
  for (const auto& [name, empty] :
       {std::pair{"functions", mesh.functions.empty()}, std::pair{"spans", mesh.spans.empty()},
        std::pair{"refine", mesh.refine.empty()}, std::pair{"grading", mesh.grading.empty()},
        std::pair{"creases", mesh.creases.empty()}}) {
    const std::string path = fmt::format("geometry.{}", name);
    if (!empty && c.clean(path))
      c.report(path, fmt::format("found {} beside patches; allowed: in each of the patches.", name));
  }
}

double checkPatches(const CheckContext& c, const std::vector<PatchSpec>& patches) {
  checkNoCommonMesh(c);
  checkPatchNames(c, patches);
  double functions = 0.0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::string path = fmt::format("geometry.patches[{}]", i);
    if (!c.clean(path + ".shape")) continue;
    PatchCheck check(c, path, patches[i].mesh);
    std::visit(check, patches[i].shape);
    functions += check.functions();
  }
  return functions;
}

/// The key that says how fine a single shape is.
std::string sizeKey(const MeshSpec& mesh) {
  if (!mesh.spans.empty()) return "geometry.spans";
  return mesh.functions.empty() ? "geometry.refine" : "geometry.functions";
}

}  // namespace

void checkPatchDimensions(const CheckContext& c) {
  const auto* body = std::get_if<PatchesSpec>(&c.scene.geometry.shape);
  if (body == nullptr) return;
  const int dim = c.scene.dim();
  for (std::size_t i = 1; i < body->patches.size(); ++i) {
    const std::string path = fmt::format("geometry.patches[{}]", i);
    const int found = dimensionOf(body->patches[i].shape);
    if (c.clean(path + ".shape") && c.clean(path + ".degrees") && found > 0 && found != dim)
      c.report(path,
               fmt::format("found a shape of {} dimensions; allowed: {} dimensions, as the first patch has.",
                           found, dim));
  }
}

void checkGeometry(const CheckContext& c) {
  if (!c.clean("geometry.shape")) return;
  double functions = 0.0;
  std::string path = "geometry.patches";
  if (const auto* body = std::get_if<PatchesSpec>(&c.scene.geometry.shape)) {
    functions = checkPatches(c, body->patches);
  } else {
    PatchCheck check(c, "geometry", c.scene.geometry.mesh);
    std::visit(check, c.scene.geometry.shape);
    functions = check.functions();
    path = sizeKey(c.scene.geometry.mesh);
  }
  if (functions > kMostFunctions && c.clean(path))
    c.report(path, fmt::format("found {:.3g} basis functions in all; allowed: at most {:.0f}.", functions,
                               kMostFunctions));
}

}  // namespace burnish
