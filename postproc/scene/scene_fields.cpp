#include "postproc/scene/scene_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/material/material.h"
#include "postproc/mesh/contact_field.h"

namespace burnish {
namespace {

bool hasFriction(const Scene& scene) {
  const auto rubs = [](const auto& contact) { return contact.options.hasFriction(); };
  return std::ranges::any_of(scene.contact, rubs) || std::ranges::any_of(scene.selfContact, rubs);
}

}  // namespace

std::string fieldProblem(const Scene& scene, const std::string& field) {
  for (std::string problem :
       {componentProblem(scene.dim(), field), lawProblem(scene, field), contactProblem(scene, field)})
    if (!problem.empty()) return problem;
  return {};
}

std::string componentProblem(int dim, const std::string& field) {
  const bool isOfSpace = field == "displacement.z" || field == "stress.yz" || field == "stress.zx";
  if (dim == 3 || !isOfSpace) return {};
  return fmt::format(
      "found {}, a component of three-dimensional scenes; allowed here: the "
      "components in x and y, and stress.zz.",
      field);
}

std::string lawProblem(const Scene& scene, const std::string& field) {
  std::string why;
  for (const BodySpec& body : scene.allBodies()) {
    why = whyWithout(body.material, field);
    if (why.empty()) return {};
  }
  return fmt::format("found {}, but {}; allowed here: another field, such as von_mises.", field, why);
}

std::string contactProblem(const Scene& scene, const std::string& field) {
  if (!isContactField(field)) return {};
  if (scene.contact.empty() && scene.selfContact.empty())
    return fmt::format(
        "found {}, but the scene has no contact; allowed here: a field of bodies, such as von_mises.", field);
  if (!isOfFriction(field) || hasFriction(scene)) return {};
  return fmt::format(
      "found {}, but no contact of the scene has friction; allowed here: another field, such as "
      "contact_pressure.",
      field);
}

}  // namespace burnish
