#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/scene/check_context.h"

namespace burnish {
namespace {

void checkMortarDegree(const CheckContext& c) {
  constexpr int highest = 7;
  const auto& pairs = c.scene.contact;
  const bool mortar =
      !c.scene.selfContact.empty() || std::any_of(pairs.begin(), pairs.end(), [](const ContactSpec& pair) {
        return pair.options.method != Enforcement::PointwisePenalty;
      });
  if (mortar && c.scene.basis == BasisChoice::Lagrange && c.scene.degree > highest && c.clean("degree"))
    c.report("degree", fmt::format("found {}; allowed for mortar contact with Lagrange elements: at most {}, "
                                   "above it the integral of a basis function is no longer positive.",
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
    const double yield = Formula({formula}, {}, {"ep"}).at(std::array{0.0});
    if (yield <= 0.0)
      c.report(path,
               fmt::format("found a yield stress of {} at ep = 0; allowed: a formula that is positive there.",
                           yield));
  } catch (const FormulaError&) {
    c.report(path, "found no finite yield stress at ep = 0; allowed: a formula that is positive there.");
  } catch (const Error& e) {
    c.report(path, fmt::format("{}; allowed: a formula in ep.", e.what()));
  }
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
  if (const auto* j2 = std::get_if<J2Spec>(&c.scene.material)) {
    if (const auto* table = std::get_if<TableHardeningSpec>(&j2->hardening)) checkTable(c, *table);
    if (const auto* law = std::get_if<FormulaHardeningSpec>(&j2->hardening)) checkFormula(c, law->formula);
  }
}

}  // namespace burnish
