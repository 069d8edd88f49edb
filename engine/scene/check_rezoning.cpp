#include <fmt/format.h>

#include "engine/scene/check_context.h"

namespace burnish {
namespace {

/// What a scene with rezoning cannot have.
void refuse(const CheckContext& c, bool found, const std::string& path, const std::string& what) {
  if (found && c.clean(path))
    c.report(path, fmt::format("found {} in a scene with rezoning; allowed there: none.", what));
}

void checkContact(const CheckContext& c) {
  if (!c.clean("contact")) return;
  const auto& contact = c.scene.contact;
  if (contact.empty())
    c.report("rezoning",
             "found in a scene without contact; allowed: with one contact face, which tells where knot spans "
             "are needed.");
  for (std::size_t k = 0; k < contact.size(); ++k) {
    refuse(c, k > 0, fmt::format("contact[{}]", k), "a second contact pair");
    refuse(c, !contact[k].against.empty(), fmt::format("contact[{}].against", k), "contact between bodies");
    const ContactOptions& options = contact[k].options;
    refuse(c, options.hasFriction() && averagesGaps(options.method),
           fmt::format("contact[{}].{}", k, options.rough ? "rough" : "friction"),
           "friction with augmented-lagrangian (integral-augmented-lagrangian carries it over)");
    if (isPenalty(options.method) && c.clean(fmt::format("contact[{}].method", k)))
      c.report(fmt::format("contact[{}].method", k),
               "found a penalty method in a scene with rezoning; allowed there: augmented-lagrangian | "
               "integral-augmented-lagrangian.");
  }
}

bool hasCreases(const GeometrySpec& geometry) {
  for (const auto& creases : geometry.mesh.creases)
    if (!creases.empty()) return true;
  return false;
}

bool hasRepeatedKnots(const GeometrySpec& geometry) {
  const auto* net = std::get_if<ControlNetBody>(&geometry.shape);
  if (net == nullptr) return false;
  for (const auto& knots : net->knots)
    for (std::size_t k = 1; k < knots.size(); ++k)
      if (knots[k] == knots[k - 1] && knots[k] != knots.front() && knots[k] != knots.back()) return true;
  return false;
}

}  // namespace

void checkRezoning(const CheckContext& c) {
  if (!c.scene.rezoning || !c.clean("rezoning")) return;
  if (c.dimensionIsKnown() && c.scene.dim() == 3)
    return c.report("rezoning", "found in a scene of three dimensions; allowed: in two.");
  if (c.scene.allBodies().size() > 1)
    return c.report("rezoning", fmt::format("found in a scene of {} bodies; allowed: in a scene of one body.",
                                            c.scene.bodies.size()));
  const GeometrySpec& geometry = c.scene.allBodies().front().geometry;
  const auto key = [&](const char* name) { return c.scene.bodyKey(0, name); };
  if (std::holds_alternative<PatchesSpec>(geometry.shape))
    return c.report("rezoning", "found for a body of several patches; allowed: a body of one.");
  refuse(c, hasCreases(geometry), key("geometry.creases"), "creases, which new meshes would lose,");
  refuse(c, hasRepeatedKnots(geometry), key("geometry.knots"),
         "knots that are repeated inside, whose corners new meshes would lose,");
  refuse(c, !c.scene.loads.empty(), "loads", "loads");
  for (std::size_t k = 0; k < c.scene.supports.size(); ++k) {
    const std::string path = fmt::format("supports[{}]", k);
    refuse(c, c.scene.supports[k].prescribe.has_value(), path + ".prescribe",
           "displacements given by formulas of places, which new meshes would move,");
    refuse(c, !c.scene.supports[k].place.part.empty() || !c.scene.supports[k].place.length.empty(), path,
           "a support on a part of a face");
  }
  for (std::size_t k = 0; k < c.scene.tools.size(); ++k)
    refuse(c, c.scene.tools[k].carry.has_value(), fmt::format("tools[{}].carry", k),
           "a tool that carries a load");
  for (std::size_t k = 0; k < c.scene.measures.size(); ++k) {
    const auto& kind = c.scene.measures[k].kind;
    refuse(c,
           std::holds_alternative<PointMeasureSpec>(kind) || std::holds_alternative<FaceMeasureSpec>(kind) ||
               std::holds_alternative<ErrorMeasureSpec>(kind),
           fmt::format("measures[{}]", k), "a measure of points of the undeformed mesh");
  }
  checkContact(c);
}

}  // namespace burnish
