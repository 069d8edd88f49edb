#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/material/first_reference.h"
#include "engine/material/rate_dependence.h"
#include "engine/scene/check_context.h"

namespace burnish::inline scene {
namespace {

/// What a scene with rezoning cannot have.
void refuse(const CheckContext& c, bool found, const std::string& path, const std::string& what) {
  if (found && c.clean(path))
    c.report(path, fmt::format("found {} in a scene with rezoning; allowed there: none.", what));
}

/// The body at points of whose undeformed mesh a measure looks; none for other measures.
std::optional<std::string> bodyOfPoints(const SceneMeasureSpec& measure) {
  if (const auto* point = std::get_if<PointMeasureSpec>(&measure.kind)) return point->body;
  if (const auto* face = std::get_if<FaceMeasureSpec>(&measure.kind)) return face->place.body;
  if (const auto* error = std::get_if<ErrorMeasureSpec>(&measure.kind)) return error->body;
  return std::nullopt;
}

/// Whether a place is on the body that is meshed anew.
bool isMeshedAnew(const CheckContext& c, const std::string& body) {
  return c.scene.bodyNumber(body) == c.scene.rezonedBody();
}

bool touchesMeshedAnew(const CheckContext& c, const ToolSpec& tool) {
  return std::ranges::any_of(c.scene.contact, [&](const ContactSpec& contact) {
    return contact.against.empty() && contact.tool == tool.name && isMeshedAnew(c, contact.place.body);
  });
}

/// Of the body, new meshes cannot carry penalties over; of others, tractions that these remember.
void refusePenalty(const CheckContext& c, const ContactOptions& options, bool isOfBody,
                   const std::string& path) {
  if (isPenalty(options.method) && (isOfBody || options.hasFriction()) && c.clean(path))
    c.report(path, fmt::format("found a penalty method{} in a scene with rezoning; allowed there: "
                               "augmented-lagrangian | integral-augmented-lagrangian.",
                               isOfBody ? "" : " with friction"));
}

/// Laws whose history a new mesh does not take over. material: its key.
void refuseHistory(const CheckContext& c, const MaterialParameters& law, const std::string& material) {
  refuse(c, dependsOnRate(law), material + ".rate",
         "a rate, whose overstress would be lost where a new mesh settles in no time,");
  refuse(c, belongsToFirstReference(law), material + ".frame",
         "an additive frame, whose plastic strain belongs to the first undeformed state,");
}

/// A pair of faces. found: whether the body has had a contact before; becomes true where it has one here.
void checkPair(const CheckContext& c, const ContactSpec& pair, const std::string& path, bool& found) {
  const bool isSlave = isMeshedAnew(c, pair.place.body);
  const bool isMaster = std::any_of(pair.against.begin(), pair.against.end(),
                                    [&](const FaceSpec& face) { return isMeshedAnew(c, face.body); });
  refuse(c, isSlave && isMaster, path + ".against", "contact of two faces of the body that is meshed anew");
  refuse(c, isSlave && pair.options.hasFriction() && pair.options.method == Enforcement::AugmentedLagrangian,
         path + (pair.options.rough ? ".rough" : ".friction"),
         "friction with augmented-lagrangian on the body that is meshed anew (integral-augmented-lagrangian "
         "carries it over, and so does naming the other body first)");
  refusePenalty(c, pair.options, isSlave || isMaster, path + ".method");
  found = found || isSlave || isMaster;
}

void checkContact(const CheckContext& c) {
  if (!c.clean("contact")) return;
  bool found = false, hasTool = false;
  for (std::size_t k = 0; k < c.scene.contact.size(); ++k) {
    const ContactSpec& contact = c.scene.contact[k];
    const std::string path = fmt::format("contact[{}]", k);
    if (!contact.against.empty()) {
      checkPair(c, contact, path, found);
      continue;
    }
    refusePenalty(c, contact.options, isMeshedAnew(c, contact.place.body), path + ".method");
    if (!isMeshedAnew(c, contact.place.body)) continue;
    refuse(c, hasTool, path, "a second contact with a tool");
    found = hasTool = true;
  }
  if (!found)
    c.report(
        "rezoning",
        "found for a body without contact; allowed: with a contact face, which tells where knot spans are "
        "needed.");
  for (std::size_t k = 0; k < c.scene.selfContact.size(); ++k)
    refusePenalty(c, c.scene.selfContact[k].options, isMeshedAnew(c, c.scene.selfContact[k].place.body),
                  fmt::format("self_contact[{}].method", k));
}

bool hasCreases(const GeometrySpec& geometry) {
  for (const auto& creases : geometry.mesh.creases)
    if (!creases.empty()) return true;
  return false;
}

/// Whether knots of a shape of its own stand several times inside. Only for one that is sound.
bool hasRepeatedKnots(const GeometrySpec& geometry) {
  return std::visit(
      []<class Shape>(const Shape& shape) {
        if constexpr (BringsKnots<Shape>)
          for (const KnotVector& direction : shape.knotVectors())
            if (direction.numFunctions() != direction.numSpans() + direction.degree()) return true;
        return false;
      },
      geometry.shape);
}

/// Keys of the rezoning that say something in the plane alone.
void refusePlaneKeys(const CheckContext& c) {
  const RezoningOptions &found = *c.scene.rezoning, left = {};
  for (const auto& [key, isGiven] : {
           std::pair{"stretch", found.stretch != left.stretch},
           std::pair{"quality", found.quality != left.quality},
           std::pair{"spans", !found.spans.empty()},
           std::pair{"ahead", found.ahead.has_value()},
           std::pair{"behind", found.behind.has_value()},
           std::pair{"growth", found.mesh.growth != left.mesh.growth},
           std::pair{"turn", found.mesh.turn != left.mesh.turn},
           std::pair{"first_layer", found.mesh.firstLayer != left.mesh.firstLayer},
           std::pair{"smallest_determinant", found.mesh.smallestDeterminant != left.mesh.smallestDeterminant},
       })
    if (isGiven)
      c.report(fmt::format("rezoning.{}", key),
               fmt::format("found {} in a scene of three dimensions; allowed there: travel, and the keys of "
                           "the body's resolution.",
                           key));
}

/// A box whose knots follow a tool; its reference stays, so that less is refused than in the plane.
void checkInSpace(const CheckContext& c) {
  refusePlaneKeys(c);
  if (c.scene.allBodies().size() > 1)
    return c.report("rezoning", "found in a scene of several bodies in space; allowed: of one.");
  if (!checkBodyName(c, "rezoning", c.scene.rezoning->body)) return;
  const BodySpec& body = c.scene.allBodies().front();
  const auto key = [&](const char* name) { return c.scene.bodyKey(0, name); };
  if (!c.clean(key("geometry"))) return;
  if (!body.geometry.mesh.resolution)
    return c.report("rezoning",
                    "found in a scene of three dimensions for a body without a resolution; allowed: a box "
                    "with geometry.resolution, whose fine spans then follow the tool.");
  refuse(c, hasCreases(body.geometry), key("geometry.creases"), "creases, which new meshes would lose,");
  refuse(c, !body.geometry.mesh.relief.empty(), key("geometry.relief"),
         "a relief, which every mesh would have another one of,");
  refuseHistory(c, body.material, key("material"));
  refuse(c, body.initial.has_value(), key("initial"), "an initial state of a body in space");
  for (std::size_t k = 0; k < c.scene.supports.size(); ++k)
    refuse(c, !c.scene.supports[k].place.part.empty(), fmt::format("supports[{}]", k),
           "a support on a part of a face, which holds other points on every mesh,");
  for (std::size_t k = 0; k < c.scene.contact.size(); ++k)
    refusePenalty(c, c.scene.contact[k].options, true, fmt::format("contact[{}].method", k));
  refuse(c, !c.scene.selfContact.empty(), "self_contact", "contact of a body in space with itself");
}

}  // namespace

void checkRezoning(const CheckContext& c) {
  if (!c.scene.rezoning || !c.clean("rezoning")) return;
  if (c.dimensionIsKnown() && c.scene.dim() == 3) return checkInSpace(c);
  if (!checkBodyName(c, "rezoning", c.scene.rezoning->body)) return;
  const std::size_t body = c.scene.rezonedBody();
  const GeometrySpec& geometry = c.scene.allBodies()[body].geometry;
  const auto key = [&](const char* name) { return c.scene.bodyKey(body, name); };
  if (std::holds_alternative<PatchesSpec>(geometry.shape))
    return c.report("rezoning", "found for a body of several patches; allowed: a body of one.");
  const bool isNet = std::holds_alternative<ControlNetBody>(geometry.shape);
  const bool hasCorners = c.clean(key("geometry")) && hasRepeatedKnots(geometry);
  refuse(c, hasCreases(geometry), key("geometry.creases"), "creases, which new meshes would lose,");
  refuse(c, hasCorners, key(isNet ? "geometry.knots" : "geometry"),
         "knots that are repeated inside, whose corners new meshes would lose,");
  refuseHistory(c, c.scene.allBodies()[body].material, key("material"));
  for (std::size_t k = 0; k < c.scene.loads.size(); ++k)
    refuse(c, isMeshedAnew(c, c.scene.loads[k].place.body), fmt::format("loads[{}]", k),
           "a load on the body");
  for (std::size_t k = 0; k < c.scene.supports.size(); ++k) {
    const std::string path = fmt::format("supports[{}]", k);
    if (!isMeshedAnew(c, c.scene.supports[k].place.body)) continue;
    refuse(c, c.scene.supports[k].symmetry && c.scene.supports[k].until, path + ".until",
           "a plane of symmetry that lets go (fix with the components to hold may)");
    refuse(c, c.scene.supports[k].prescribe.has_value(), path + ".prescribe",
           "displacements given by formulas of places, which new meshes would move,");
    refuse(c, !c.scene.supports[k].place.part.empty() || !c.scene.supports[k].place.length.empty(), path,
           "a support on a part of a face");
  }
  for (std::size_t k = 0; k < c.scene.tools.size(); ++k) {
    const ToolSpec& tool = c.scene.tools[k];
    refuse(c, tool.carry && tool.carry->normal && touchesMeshedAnew(c, tool),
           fmt::format("tools[{}].carry.normal", k),
           "a force along the normal of a face that new meshes would move");
  }
  for (std::size_t k = 0; k < c.scene.measures.size(); ++k) {
    const std::optional<std::string> measured = bodyOfPoints(c.scene.measures[k]);
    refuse(c, measured && isMeshedAnew(c, *measured), fmt::format("measures[{}]", k),
           "a measure of points of the undeformed mesh");
  }
  checkContact(c);
}

}  // namespace burnish::inline scene
