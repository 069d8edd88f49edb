#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/nurbs/knot_vector.h"
#include "engine/scene/check_context.h"

namespace burnish {
namespace {

void checkFunctions(const CheckContext& c, std::size_t direction) {
  const int p = c.scene.degree;
  const int n = c.scene.geometry.functions[direction];
  const std::string path = fmt::format("geometry.functions[{}]", direction);
  if (n < p + 1)
    return c.report(path, fmt::format("found {}; allowed: at least {}, the degree plus one.", n, p + 1));
  if (c.scene.basis == BasisChoice::Lagrange && (n - 1) % p != 0) {
    const int elements = (n - 1) / p;
    c.report(path,
             fmt::format(
                 "found {}; allowed for Lagrange elements of degree {}: a multiple of {} plus one, such as "
                 "{} or {}.",
                 n, p, p, elements * p + 1, (elements + 1) * p + 1));
  }
}

/// Beyond this number of basis functions a direct solver does not fit any machine; the indices of its matrix
/// would overflow a little later.
constexpr double kMostFunctions = 500'000;

void checkMeshSize(const CheckContext& c) {
  const GeometrySpec& geometry = c.scene.geometry;
  const bool bySpans = geometry.functions.empty();
  double total = 1.0;
  for (const int n : bySpans ? geometry.spans : geometry.functions)
    total *= !bySpans ? n : c.scene.basis == BasisChoice::Nurbs ? n + c.scene.degree : n * c.scene.degree + 1;
  if (total > kMostFunctions)
    c.report(
        bySpans ? "geometry.spans" : "geometry.functions",
        fmt::format("found {:.3g} basis functions in all; allowed: at most {:.0f}.", total, kMostFunctions));
}

void checkNamedShape(const CheckContext& c) {
  const GeometrySpec& geometry = c.scene.geometry;
  if (c.clean("geometry.functions") && c.clean("geometry.spans")) {
    if (geometry.functions.empty() && geometry.spans.empty())
      c.report("geometry",
               "found neither functions nor spans; allowed: exactly one of the two, such as spans: [8, 4].");
    if (!geometry.functions.empty() && !geometry.spans.empty())
      c.report("geometry.spans", "found spans beside functions; allowed: one of the two.");
  }
  if (c.clean("geometry.functions") && c.clean("degree") && c.clean("basis"))
    for (std::size_t d = 0; d < geometry.functions.size(); ++d) checkFunctions(c, d);
  if (c.clean("geometry.functions") && c.clean("geometry.spans") && c.clean("degree") && c.clean("basis"))
    checkMeshSize(c);
}

void checkAnnulus(const CheckContext& c, const AnnulusSpec& ring) {
  if (c.clean("geometry.inner_radius") && c.clean("geometry.outer_radius") &&
      ring.outerRadius <= ring.innerRadius)
    c.report("geometry.outer_radius", fmt::format("found {}; allowed: a number above the inner radius {}.",
                                                  ring.outerRadius, ring.innerRadius));
  if (c.scene.basis == BasisChoice::Nurbs && c.scene.degree < 2 && c.clean("degree"))
    c.report(
        "degree",
        fmt::format("found {}; allowed for an annulus in NURBS: at least 2, a circular arc is a rational "
                    "curve of degree 2.",
                    c.scene.degree));
}

/// Number of basis functions of a control net, or 0 when a knot vector is unusable (which is reported).
std::size_t checkKnots(const CheckContext& c, const ControlNetSpec& net) {
  std::size_t functions = 1;
  for (std::size_t d = 0; d < net.knots.size(); ++d) {
    try {
      functions *= static_cast<std::size_t>(KnotVector(net.degrees[d], net.knots[d]).numFunctions());
    } catch (const Error& e) {
      c.report(fmt::format("geometry.knots[{}]", d), fmt::format("{}.", e.what()));
      functions = 0;
    }
  }
  return functions;
}

void checkPoints(const CheckContext& c, const ControlNetSpec& net) {
  const std::size_t dim = net.degrees.size();
  for (std::size_t i = 0; i < net.points.size(); ++i)
    if (net.points[i].size() != dim)
      c.report(fmt::format("geometry.points[{}]", i),
               fmt::format("found {} coordinates; allowed: {}, one per direction of the body.",
                           net.points[i].size(), dim));
}

void checkControlNet(const CheckContext& c, const ControlNetSpec& net) {
  if (c.scene.basis == BasisChoice::Lagrange && c.clean("basis"))
    c.report("basis",
             "found lagrange, but the geometry is a control net with knots, which is a NURBS body; allowed: "
             "nurbs.");
  for (const char* key : {"functions", "spans"})
    if (const YamlNode* node = c.root.find("geometry"); node != nullptr && node->find(key) != nullptr)
      c.report(fmt::format("geometry.{}", key),
               "a control net is taken as it is given; allowed: leave the key out (its knots say how many "
               "functions).");
  if (!c.clean("geometry.degrees")) return;

  const auto& degrees = net.degrees;
  if (c.root.find("degree") != nullptr && c.clean("degree") &&
      c.scene.degree != *std::max_element(degrees.begin(), degrees.end()))
    c.report("degree",
             fmt::format("found {}, but the control net has the degrees {}; allowed: leave the key out.",
                         c.scene.degree, fmt::join(degrees, ", ")));
  if (c.clean("geometry.points")) checkPoints(c, net);
  if (!c.clean("geometry.knots")) return;
  if (net.knots.size() != degrees.size())
    return c.report("geometry.knots",
                    fmt::format("found {} knot vectors for {} degrees; allowed: one per direction.",
                                net.knots.size(), degrees.size()));
  const std::size_t functions = checkKnots(c, net);
  if (functions > 0 && net.points.size() != functions && c.clean("geometry.points"))
    c.report("geometry.points",
             fmt::format("found {} points; allowed: {}, as many as the knots make basis functions.",
                         net.points.size(), functions));
}

void checkWeights(const CheckContext& c, const ControlNetSpec& net) {
  if (!net.weights.empty() && net.weights.size() != net.points.size() && c.clean("geometry.points") &&
      c.clean("geometry.weights"))
    c.report("geometry.weights",
             fmt::format("found {} weights for {} points; allowed: one per control point.",
                         net.weights.size(), net.points.size()));
}

void checkMortarDegree(const CheckContext& c) {
  constexpr int highest = 7;
  const auto& pairs = c.scene.contact;
  const bool mortar = std::any_of(pairs.begin(), pairs.end(), [](const ContactSpec& pair) {
    return pair.method != ContactMethod::PointwisePenalty;
  });
  if (mortar && c.scene.basis == BasisChoice::Lagrange && c.scene.degree > highest && c.clean("degree"))
    c.report(
        "degree",
        fmt::format("found {}; allowed for mortar contact with Lagrange elements: at most {}, above it the "
                    "integral of a basis function is no longer positive.",
                    c.scene.degree, highest));
}

void checkTable(const CheckContext& c, const TableHardeningSpec& table) {
  const std::string path = "material.hardening";
  if (!c.clean(path)) return;
  if (table.ep.front() != 0.0)
    c.report(path + ".ep[0]",
             fmt::format("found {}; allowed: 0, the table begins without plastic strain.", table.ep.front()));
  if (table.stress.size() != table.ep.size())
    c.report(path + ".stress", fmt::format("found {} stresses for {} plastic strains; allowed: one for each.",
                                           table.stress.size(), table.ep.size()));
}

void checkFormula(const CheckContext& c, const std::string& formula) {
  const std::string path = "material.hardening.formula";
  if (!c.clean(path)) return;
  try {
    double ep = 0.0;
    mu::Parser parser;
    parser.DefineVar("ep", &ep);
    parser.SetExpr(formula);
    const double yield = parser.Eval();
    if (!std::isfinite(yield) || yield <= 0.0)
      c.report(path,
               fmt::format("found a yield stress of {} at ep = 0; allowed: a formula that is positive there.",
                           yield));
  } catch (const mu::ParserError& e) {
    c.report(path, fmt::format("found \"{}\", which cannot be understood ({}); allowed: a formula in ep.",
                               formula, e.GetMsg()));
  }
}

}  // namespace

void checkBody(const CheckContext& c) {
  if (c.clean("geometry.shape")) {
    if (const auto* net = std::get_if<ControlNetSpec>(&c.scene.geometry.shape)) {
      checkControlNet(c, *net);
      checkWeights(c, *net);
    } else {
      checkNamedShape(c);
    }
    if (const auto* ring = std::get_if<AnnulusSpec>(&c.scene.geometry.shape)) checkAnnulus(c, *ring);
  }
  checkMortarDegree(c);
  if (const auto* j2 = std::get_if<J2Spec>(&c.scene.material)) {
    if (const auto* table = std::get_if<TableHardeningSpec>(&j2->hardening)) checkTable(c, *table);
    if (const auto* law = std::get_if<FormulaHardeningSpec>(&j2->hardening)) checkFormula(c, law->formula);
  }
}

}  // namespace burnish
