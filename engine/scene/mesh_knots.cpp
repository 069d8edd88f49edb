#include "engine/scene/mesh_knots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/quoted.h"
#include "engine/nurbs/refinement.h"

namespace burnish::inline scene {
namespace {

/// Smallest share of a graded span, and tolerance of the grading at its ends.
constexpr double kSmallest = 1e-12;

/// The inner ones of the points k/n.
std::vector<double> equalFractions(int parts) {
  std::vector<double> fractions;
  for (int k = 1; k < parts; ++k) fractions.push_back(static_cast<double>(k) / parts);
  return fractions;
}

[[noreturn]] void rejectGrading(const std::string& text, double s, double value, const std::string& after) {
  throw Error(
      fmt::format("found {}, which takes s = {:.6g} to {:.6g}{}; allowed: a formula in s that grows from 0 "
                  "at s = 0 to 1 at s = 1",
                  quoted(text), s, value, after));
}

/// The grading at the inner ones of the points k/n.
std::vector<double> gradedFractions(const FormulaText& text, const std::vector<DefinitionSpec>& definitions,
                                    int parts) {
  const Formula grading(text, definitions, {"s"});
  const double begin = grading.at(std::array{0.0}), end = grading.at(std::array{1.0});
  if (std::abs(begin) > kSmallest) rejectGrading(text.text, 0.0, begin, "");
  if (std::abs(end - 1.0) > kSmallest) rejectGrading(text.text, 1.0, end, "");
  std::vector<double> fractions;
  double before = 0.0;
  for (int k = 1; k <= parts; ++k) {
    const double s = static_cast<double>(k) / parts, value = k < parts ? grading.at(std::array{s}) : 1.0;
    if (!(value > before + kSmallest))
      rejectGrading(text.text, s, value, fmt::format(" after {:.6g}", before));
    if (k < parts) fractions.push_back(value);
    before = value;
  }
  return fractions;
}

bool hasPathMesh(const MeshSpec& mesh) {
  return mesh.resolution && !mesh.resolution->breaks.empty();
}

bool areEqual(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) <= kSmallest; });
}

}  // namespace

int partsOf(const BodySpec& body, const MeshSpec& mesh, std::size_t direction) {
  if (!mesh.spans.empty()) return mesh.spans[direction];
  if (hasPathMesh(mesh)) return static_cast<int>(mesh.resolution->breaks[direction].size()) + 1;
  if (!mesh.refine.empty()) return mesh.refine[direction];
  if (mesh.functions.empty()) return 1;
  const int functions = mesh.functions[direction];
  return body.basis == BasisChoice::Nurbs ? functions - body.degree : (functions - 1) / body.degree;
}

KnotVector meshKnots(const BodySpec& body, const std::vector<DefinitionSpec>& definitions,
                     const MeshSpec& mesh, std::size_t direction, const KnotVector& shape) {
  const int parts = partsOf(body, mesh, direction);
  std::vector<double> fractions =
      hasPathMesh(mesh) ? mesh.resolution->breaks[direction] : equalFractions(parts);
  if (!mesh.grading.empty()) {
    const FormulaText& text = mesh.grading[direction];
    const auto graded = gradedFractions(text, definitions, parts);
    if (shape.numSpans() > 1 && !areEqual(graded, fractions))
      throw Error(
          fmt::format("found {}, but the control net has {} knot spans in this direction, not one to be "
                      "graded; allowed: s, and graded knots in the net itself",
                      quoted(text.text), shape.numSpans()));
    fractions = graded;
  }
  KnotVector knots = divided(elevated(shape, std::max(body.degree - shape.degree(), 0)), fractions);
  return mesh.creases.empty() ? knots : creased(knots, mesh.creases[direction]);
}

int numFunctions(const BodySpec& body, const KnotVector& knots) {
  return body.basis == BasisChoice::Nurbs ? knots.numFunctions() : knots.numSpans() * body.degree + 1;
}

}  // namespace burnish::inline scene
