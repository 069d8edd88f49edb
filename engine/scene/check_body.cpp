#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/quoted.h"
#include "engine/material/initial_states.h"
#include "engine/scene/check_context.h"
#include "engine/schema/problems.h"

namespace burnish::inline scene {
namespace {

/// Whether a face of the body carries multipliers.
bool hasMortarContact(const Scene& scene, std::size_t body) {
  const auto isMortar = [&](const auto& contact) {
    return scene.bodyNumber(contact.place.body) == body && averagesGaps(contact.options.method);
  };
  return std::ranges::any_of(scene.selfContact, isMortar) || std::ranges::any_of(scene.contact, isMortar);
}

void checkMortarDegree(const CheckContext& c, std::size_t number) {
  constexpr int highest = 7;
  const BodySpec& body = c.scene.allBodies()[number];
  if (hasMortarContact(c.scene, number) && body.basis == BasisChoice::Lagrange && body.degree > highest &&
      c.cleanOf(number, "degree"))
    c.report(c.scene.bodyKey(number, "degree"),
             fmt::format("found {}; allowed for mortar contact with Lagrange elements: at most {}, "
                         "above it the integral of a basis function is no longer positive.",
                         body.degree, highest));
}

/// Stress and plastic strain at the start: formulas of the place alone.
void checkInitial(const CheckContext& c, std::size_t number) {
  const BodySpec& body = c.scene.allBodies()[number];
  const std::string path = c.scene.bodyKey(number, "initial");
  if (!body.initial) return;
  const auto check = [&](const std::string& key, const std::optional<FormulaText>& text) {
    if (!text) return;
    checkFormula(c, key, *text);
    if (c.clean(key) && c.clean("definitions") && Formula(*text, c.scene.definitions).dependsOn("t"))
      c.report(key, fmt::format("found {}, which depends on t; allowed: X, Y, Z and the definitions.",
                                quoted(text->text)));
  };
  check(path + ".plastic_strain", body.initial->plasticStrain);
  if (body.initial->plasticStrain && !carriesPlasticStrain(body.material) && c.clean(path))
    c.report(path + ".plastic_strain",
             "found for a material that does not flow; allowed: for one that does, or leave the key out.");
  if (!body.initial->stress) return;
  const InitialStressSpec& stress = *body.initial->stress;
  const std::array<std::pair<const char*, const std::optional<FormulaText>*>, 6> components{
      {{"xx", &stress.xx},
       {"yy", &stress.yy},
       {"zz", &stress.zz},
       {"xy", &stress.xy},
       {"yz", &stress.yz},
       {"zx", &stress.zx}}};
  for (const auto& [name, text] : components) check(fmt::format("{}.stress.{}", path, name), *text);
  for (const auto& [name, text] : {components[4], components[5]})
    if (const std::string key = fmt::format("{}.stress.{}", path, name);
        *text && c.clean(key) && c.dimensionIsKnown() && c.scene.dim() == 2)
      c.report(key, "found a component of three-dimensional scenes; allowed here: xx, yy, zz and xy.");
}

/// As many as the degree keep the order of convergence; the functions of smooth splines vanish at all of them nowhere.
int fewestPoints(const BodySpec& body) {
  return body.basis == BasisChoice::Nurbs && body.degree > 1 ? body.degree : body.degree + 1;
}

void checkBody(const CheckContext& c, std::size_t number) {
  const BodySpec& body = c.scene.allBodies()[number];
  checkGeometry(c, number);
  if (c.cleanOf(number, "quadrature_points") && c.cleanOf(number, "degree") && body.quadraturePoints &&
      *body.quadraturePoints < fewestPoints(body))
    c.report(c.scene.bodyKey(number, "quadrature_points"),
             fmt::format("found {}; allowed: at least {}, the degree{}.", *body.quadraturePoints,
                         fewestPoints(body), fewestPoints(body) > body.degree ? " plus one" : ""));
  checkMortarDegree(c, number);
  checkInitial(c, number);
  checkMaterial(body.material, Problems(c.root, c.errors, c.scene.bodyKey(number, "material")),
                c.dimensionIsKnown() && c.scene.dim() == 2);
}

/// Several bodies stand in place of one, and have names of their own.
void checkList(const CheckContext& c) {
  for (const char* key : {"geometry", "material"})
    if (!c.scene.bodies.empty() && c.root.find(key) != nullptr)
      c.report(key, fmt::format("found {} beside bodies; allowed: in each of the bodies.", key));
  std::set<std::string> names;
  for (const ToolSpec& tool : c.scene.tools) names.insert(tool.name);
  for (std::size_t k = 0; k < c.scene.bodies.size(); ++k) {
    const std::string path = fmt::format("bodies[{}].name", k), &name = c.scene.bodies[k].name;
    if (c.clean(path) && !names.insert(name).second)
      c.report(path, fmt::format("found {}, the name of another body or a tool; allowed: a name of its own.",
                                 name));
  }
}

}  // namespace

void checkBodies(const CheckContext& c) {
  if (!c.bodiesAreRead()) return;
  checkList(c);
  if (c.dimensionIsKnown() && c.scene.dim() == 3 && c.scene.kinematics == KinematicsChoice::Axisymmetric)
    c.report("kinematics", "found axisymmetric for a body of three dimensions; allowed: leave the key out.");
  for (std::size_t k = 0; k < c.scene.allBodies().size(); ++k) checkBody(c, k);
}

}  // namespace burnish::inline scene
