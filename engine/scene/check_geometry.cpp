#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>

#include "engine/core/error.h"
#include "engine/core/input_error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/patch.h"
#include "engine/scene/check_context.h"
#include "engine/scene/dimension.h"
#include "engine/scene/mesh_knots.h"
#include "engine/scene/path_mesh.h"
#include "engine/schema/problems.h"

namespace burnish::inline scene {
namespace {

/// Beyond this number of basis functions a direct solver does not fit any machine; the indices of its matrix
/// would overflow a little later.
constexpr double kMostFunctions = 500'000;

/// Checks of one patch of a body, whose keys are at `at`.
class PatchCheck {
 public:
  PatchCheck(const CheckContext& c, std::size_t body, std::string at, const MeshSpec& mesh)
      : c_(c),
        number_(body),
        body_(c.scene.allBodies()[body]),
        at_(at),
        problems_(c.root, c.errors, std::move(at)),
        mesh_(mesh) {}

  template <class Shape>
  void operator()(const Shape& shape);
  template <BringsKnots Shape>
  void operator()(const Shape& shape);
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

  void checkArcDegree(const char* shape) const;
  void checkResolution() const;
  void checkNamed(std::span<const int> degrees);
  void checkNumberOfFunctions(std::size_t direction) const;
  void checkCreases() const;
  void checkRelief(std::size_t dim) const;
  void checkPlaceFormula(const std::string& path, const FormulaText& formula) const;
  void checkProfile(const std::string& path, const ReliefSpec& relief) const;
  void checkMesh(std::size_t dim, const std::function<std::vector<KnotVector>()>& knotsOfShape);
  void countFunctions(const std::vector<KnotVector>& shape);

  const CheckContext& c_;
  std::size_t number_;
  const BodySpec& body_;
  std::string at_;
  Problems problems_;
  const MeshSpec& mesh_;
  double functions_ = 0.0;
};

template <class Shape>
void PatchCheck::operator()(const Shape& shape) {
  if constexpr (requires { check(shape, problems_); }) check(shape, problems_);
  constexpr auto& degrees = Shape::kind.degrees;
  if (std::ranges::max(degrees) > 1) checkArcDegree(Shape::kind.name);
  checkNamed(degrees);
}

void PatchCheck::checkArcDegree(const char* shape) const {
  if (body_.basis == BasisChoice::Nurbs && body_.degree < 2 && c_.cleanOf(number_, "degree"))
    c_.report(
        c_.scene.bodyKey(number_, "degree"),
        fmt::format(
            "found {}; allowed for {} in NURBS: at least 2, a circular arc is a rational curve of degree 2.",
            body_.degree, shape));
}

/// Of the one box of a body. What is wrong with tools and contacts is said there.
void PatchCheck::checkResolution() const {
  for (const auto& [name, isGiven] :
       {std::pair{"functions", !mesh_.functions.empty()}, std::pair{"spans", !mesh_.spans.empty()},
        std::pair{"grading", !mesh_.grading.empty()}})
    if (isGiven && clean(name))
      report(name, fmt::format("found {} beside resolution; allowed: one of the two.", name));
  if (!clean("resolution") || !c_.clean("tools") || !c_.clean("contact")) return;
  if (&mesh_ != &body_.geometry.mesh)
    return report("resolution",
                  "found in one of several patches; allowed: in a body of one box or rectangle.");
  try {
    requirePathMesh(c_.scene, number_);
  } catch (const InputError& error) {
    const auto& [path, text] = error.problems().front();
    c_.report(path.empty() ? key("resolution") : fmt::format("{}.{}", key("resolution"), path), text);
  } catch (const Error&) {
    // What is wrong with the tool or the contact is said there.
  }
}

void PatchCheck::checkNumberOfFunctions(std::size_t direction) const {
  const int p = body_.degree;
  const int n = mesh_.functions[direction];
  if (n < p + 1)
    return reportEntry("functions", direction,
                       fmt::format("found {}; allowed: at least {}, the degree plus one.", n, p + 1));
  if (body_.basis == BasisChoice::Lagrange && (n - 1) % p != 0) {
    const int elements = (n - 1) / p;
    reportEntry("functions", direction,
                fmt::format("found {}; allowed for Lagrange elements of degree {}: a multiple of {} plus "
                            "one, such as {} or {}.",
                            n, p, p, elements * p + 1, (elements + 1) * p + 1));
  }
}

/// Shapes of one knot span per direction, with the degrees that describe them exactly.
void PatchCheck::checkNamed(std::span<const int> degrees) {
  if (mesh_.resolution) {
    checkResolution();
  } else if (clean("functions") && clean("spans")) {
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
  if (clean("functions") && c_.cleanOf(number_, "degree") && c_.cleanOf(number_, "basis"))
    for (std::size_t d = 0; d < mesh_.functions.size(); ++d) checkNumberOfFunctions(d);
  checkMesh(degrees.size(), [&] {
    std::vector<KnotVector> shape;
    for (const int degree : degrees) shape.push_back(KnotVector::uniform(degree, 1));
    return shape;
  });
}

template <BringsKnots Shape>
void PatchCheck::operator()(const Shape& shape) {
  for (const auto& [name, given] :
       {std::pair{"functions", &mesh_.functions}, std::pair{"spans", &mesh_.spans}})
    if (!given->empty() && clean(name))
      report(name, fmt::format("found {}, but {} brings its own knots; allowed: refine.", name, Shape::name));
  if (mesh_.resolution && clean("resolution"))
    report("resolution",
           fmt::format("found resolution, but {} brings its own knots; allowed: refine.", Shape::name));
  check(shape, problems_);
  if (shape.dim() == 0 || !clean("degrees") || !clean("profile.degrees")) return;
  checkMesh(static_cast<std::size_t>(shape.dim()), [&] { return shape.knotVectors(); });
}

void PatchCheck::checkCreases() const {
  for (std::size_t d = 0; d < mesh_.creases.size(); ++d)
    for (std::size_t k = 0; k < mesh_.creases[d].size(); ++k)
      if (const double s = mesh_.creases[d][k]; s < 0.0 || s > 1.0)
        c_.report(fmt::format("{}.creases[{}][{}]", at_, d, k),
                  fmt::format("found {}; allowed: a number from 0 to 1.", s));
}

void PatchCheck::checkRelief(std::size_t dim) const {
  for (std::size_t k = 0; k < mesh_.relief.size(); ++k) {
    const std::string path = fmt::format("{}.relief[{}]", at_, k);
    const ReliefSpec& relief = mesh_.relief[k];
    if (c_.clean(path + ".face")) {
      try {
        dim == 2 ? faceFromName<2>(relief.face) : faceFromName<3>(relief.face);
      } catch (const Error& problem) {
        c_.report(path + ".face", fmt::format("{}.", problem.what()));
      }
    }
    if (relief.height) checkPlaceFormula(path + ".height", *relief.height);
    checkPlaceFormula(path + ".along", relief.along);
    checkProfile(path, relief);
  }
}

/// A formula in X, Y and Z.
void PatchCheck::checkPlaceFormula(const std::string& path, const FormulaText& formula) const {
  checkFormula(c_, path, formula);
  if (c_.clean(path) && c_.clean("definitions") && Formula(formula, c_.scene.definitions).dependsOn("t"))
    c_.report(
        path,
        fmt::format(
            "found {}, which depends on t; allowed: a formula in X, Y and Z, the body is what it is at the start.",
            quoted(formula.text)));
}

void PatchCheck::checkProfile(const std::string& path, const ReliefSpec& relief) const {
  const std::vector<double>&places = relief.places, &heights = relief.heights;
  const bool isMeasured = !places.empty() || !heights.empty();
  if (!c_.clean(path + ".places") || !c_.clean(path + ".heights") || !c_.clean(path + ".height") ||
      !c_.clean(path + ".file"))
    return;
  if (relief.height && isMeasured)
    c_.report(path + ".height", "found height beside a profile; allowed: one of the two.");
  if (!relief.height && !isMeasured)
    c_.report(path + ".height",
              "missing; required: height, a formula, or file, a profile that was measured.");
  if (!isMeasured) return;
  if (places.size() < 2 || places.size() != heights.size())
    c_.report(path + ".places",
              fmt::format("found {} places and {} heights; allowed: a height for each of two places or more.",
                          places.size(), heights.size()));
  else if (const auto at = std::ranges::adjacent_find(places, std::greater_equal()); at != places.end())
    c_.report(path + ".places",
              fmt::format("found {:.6g} behind {:.6g}; allowed: places that increase.", *std::next(at), *at));
}

/// knotsOfShape: in each direction; asked for if nothing is wrong with the shape.
void PatchCheck::checkMesh(std::size_t dim, const std::function<std::vector<KnotVector>()>& knotsOfShape) {
  if (clean("creases")) checkCreases();
  checkRelief(dim);
  if (!c_.clean(at_) || !c_.cleanOf(number_, "degree") || !c_.cleanOf(number_, "basis") ||
      !c_.clean("definitions"))
    return;
  try {
    countFunctions(knotsOfShape());
  } catch (const Error& problem) {
    c_.report(at_, fmt::format("{}.", problem.what()));
  }
}

/// `shape`: the knots of the shape in each direction.
void PatchCheck::countFunctions(const std::vector<KnotVector>& shape) {
  functions_ = 1.0;
  for (std::size_t d = 0; d < shape.size(); ++d)
    functions_ *= static_cast<double>(shape[d].numSpans()) * partsOf(body_, mesh_, d);
  if (functions_ > kMostFunctions) return;
  functions_ = 1.0;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    try {
      functions_ *= numFunctions(body_, meshKnots(body_, c_.scene.definitions, mesh_, d, shape[d]));
    } catch (const Error& problem) {
      reportEntry("grading", d, fmt::format("{}.", problem.what()));
    }
  }
}

/// at: path of the geometry.
void checkPatchNames(const CheckContext& c, const std::string& at, const std::vector<PatchSpec>& patches) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::string path = fmt::format("{}.patches[{}].name", at, i);
    const auto same = std::find_if(patches.begin(), patches.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const PatchSpec& other) { return other.name == patches[i].name; });
    if (c.clean(path) && same != patches.begin() + static_cast<std::ptrdiff_t>(i))
      c.report(path,
               fmt::format("found {}, the name of another patch; allowed: a name of its own for each patch.",
                           patches[i].name));
  }
}

/// With several patches, keys of the mesh stand in each of them.
void checkNoCommonMesh(const CheckContext& c, const std::string& at, const MeshSpec& mesh) {
  for (const auto& [name, empty] :
       {std::pair{"functions", mesh.functions.empty()}, std::pair{"spans", mesh.spans.empty()},
        std::pair{"refine", mesh.refine.empty()}, std::pair{"grading", mesh.grading.empty()},
        std::pair{"creases", mesh.creases.empty()}, std::pair{"relief", mesh.relief.empty()},
        std::pair{"resolution", !mesh.resolution}}) {
    const std::string path = fmt::format("{}.{}", at, name);
    if (!empty && c.clean(path))
      c.report(path, fmt::format("found {} beside patches; allowed: in each of the patches.", name));
  }
}

double checkPatches(const CheckContext& c, std::size_t body, const std::string& at,
                    const std::vector<PatchSpec>& patches) {
  checkNoCommonMesh(c, at, c.scene.allBodies()[body].geometry.mesh);
  checkPatchNames(c, at, patches);
  double functions = 0.0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::string path = fmt::format("{}.patches[{}]", at, i);
    if (!c.clean(path + ".shape")) continue;
    PatchCheck check(c, body, path, patches[i].mesh);
    std::visit(check, patches[i].shape);
    functions += check.functions();
  }
  return functions;
}

/// The key that says how fine a single shape is.
const char* sizeKey(const MeshSpec& mesh) {
  if (!mesh.spans.empty()) return "spans";
  if (mesh.resolution) return "resolution";
  return mesh.functions.empty() ? "refine" : "functions";
}

}  // namespace

bool CheckContext::dimensionIsKnownOf(std::size_t body) const {
  for (const char* key : {"shape", "degrees", "profile.degrees", "patches[0].shape", "patches[0].degrees",
                          "patches[0].profile.degrees"})
    if (!clean(scene.bodyKey(body, fmt::format("geometry.{}", key)))) return false;
  return dimensionOf(scene.allBodies()[body].geometry.shape) > 0;
}

void checkPatchDimensions(const CheckContext& c) {
  const int dim = c.scene.dim();
  const auto check = [&](const std::string& path, int found, const char* first) {
    if (c.clean(path + ".shape") && c.clean(path + ".degrees") && c.clean(path + ".profile.degrees") &&
        found > 0 && found != dim)
      c.report(path,
               fmt::format("found a shape of {} dimensions; allowed: {} dimensions, as the first {} has.",
                           found, dim, first));
  };
  const auto bodies = c.scene.allBodies();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::string at = c.scene.bodyKey(k, "geometry");
    if (k > 0 && c.dimensionIsKnownOf(k)) check(at, dimensionOf(bodies[k].geometry.shape), "body");
    if (const auto* several = std::get_if<PatchesSpec>(&bodies[k].geometry.shape))
      for (std::size_t i = 1; i < several->patches.size(); ++i)
        check(fmt::format("{}.patches[{}]", at, i), dimensionOf(several->patches[i].shape), "patch");
  }
}

void checkGeometry(const CheckContext& c, std::size_t body) {
  const std::string at = c.scene.bodyKey(body, "geometry");
  if (!c.clean(at + ".shape")) return;
  const GeometrySpec& geometry = c.scene.allBodies()[body].geometry;
  double functions = 0.0;
  std::string path = at + ".patches";
  if (const auto* several = std::get_if<PatchesSpec>(&geometry.shape)) {
    functions = checkPatches(c, body, at, several->patches);
  } else {
    PatchCheck check(c, body, at, geometry.mesh);
    std::visit(check, geometry.shape);
    functions = check.functions();
    path = fmt::format("{}.{}", at, sizeKey(geometry.mesh));
  }
  if (functions > kMostFunctions && c.clean(path))
    c.report(path, fmt::format("found {:.3g} basis functions in all; allowed: at most {:.0f}.", functions,
                               kMostFunctions));
}

}  // namespace burnish::inline scene
