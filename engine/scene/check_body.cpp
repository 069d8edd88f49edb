#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/check_context.h"
#include "engine/schema/problems.h"

namespace burnish {
namespace {

void checkMortarDegree(const CheckContext& c) {
  constexpr int highest = 7;
  const auto& pairs = c.scene.contact;
  const bool mortar = !c.scene.selfContact.empty() ||
                      std::any_of(pairs.begin(), pairs.end(),
                                  [](const ContactSpec& pair) { return averagesGaps(pair.options.method); });
  if (mortar && c.scene.basis == BasisChoice::Lagrange && c.scene.degree > highest && c.clean("degree"))
    c.report("degree", fmt::format("found {}; allowed for mortar contact with Lagrange elements: at most {}, "
                                   "above it the integral of a basis function is no longer positive.",
                                   c.scene.degree, highest));
}

}  // namespace

void checkBody(const CheckContext& c) {
  checkGeometry(c);
  if (c.dimensionIsKnown() && c.scene.dim() == 3 && c.scene.kinematics == KinematicsChoice::Axisymmetric)
    c.report("kinematics", "found axisymmetric for a body of three dimensions; allowed: leave the key out.");
  if (c.clean("quadrature_points") && c.clean("degree") && c.scene.quadraturePoints &&
      *c.scene.quadraturePoints <= c.scene.degree)
    c.report("quadrature_points", fmt::format("found {}; allowed: at least {}, the degree plus one.",
                                              *c.scene.quadraturePoints, c.scene.degree + 1));
  checkMortarDegree(c);
  checkMaterial(c.scene.material, Problems(c.root, c.errors, "material"));
}

}  // namespace burnish
