#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/scene/check_context.h"
#include "engine/schema/problems.h"

namespace burnish {
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

void checkBody(const CheckContext& c, std::size_t number) {
  const BodySpec& body = c.scene.allBodies()[number];
  checkGeometry(c, number);
  if (c.cleanOf(number, "quadrature_points") && c.cleanOf(number, "degree") && body.quadraturePoints &&
      *body.quadraturePoints <= body.degree)
    c.report(c.scene.bodyKey(number, "quadrature_points"),
             fmt::format("found {}; allowed: at least {}, the degree plus one.", *body.quadraturePoints,
                         body.degree + 1));
  checkMortarDegree(c, number);
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

}  // namespace burnish
