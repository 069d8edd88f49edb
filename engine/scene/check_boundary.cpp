#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "engine/core/nearest.h"
#include "engine/scene/check_context.h"
#include "engine/scene/check_motion.h"
#include "engine/scene/support_names.h"

namespace burnish::inline scene {
namespace {

void checkFixed(const CheckContext& c, const std::string& path, const std::vector<std::string>& fix) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < fix.size(); ++i) {
    const std::string entry = fmt::format("{}[{}]", path, i);
    if (!c.clean(entry)) continue;
    if (!seen.insert(fix[i]).second)
      c.report(entry, fmt::format("found {} a second time; allowed: each component once.", fix[i]));
    else if (fix[i] == "z" && c.dimensionIsKnown() && c.scene.dim() == 2)
      c.report(entry, "found z, a component of three-dimensional scenes; allowed here: x and y.");
  }
}

void checkSupport(const CheckContext& c, const std::string& path, const SupportSpec& support) {
  checkFace(c, path, support.place, true);
  checkFixed(c, path + ".fix", support.fix);
  if (support.move) checkTable(c, path + ".move", support.move->times, componentsOf(*support.move));
  if (support.prescribe)
    checkFormulas(c, path + ".prescribe", componentsOf(*support.prescribe),
                  [](const auto& context, const std::string& key, const FormulaText& text) {
                    checkFormula(context, key, text);
                  });
  std::vector<std::string> given;
  if (!support.fix.empty()) given.emplace_back("fix");
  if (support.move) given.emplace_back("move");
  if (support.prescribe) given.emplace_back("prescribe");
  if (support.symmetry) given.emplace_back("symmetry");
  if (given.size() != 1 && c.clean(path))
    c.report(path, fmt::format("found {}; allowed: exactly one of fix: [x, y], move: {{times: ..., y: ...}}, "
                               "prescribe: {{x: ..., y: ...}} and symmetry: true.",
                               given.empty() ? "none of fix, move, prescribe and symmetry"
                                             : fmt::format("{}", fmt::join(given, " and "))));
  checkRelease(c, path, support);
}

/// Supports are told apart by name. Where the history lists them, its other columns have other names.
void checkSupportNames(const CheckContext& c) {
  const std::vector<std::string> names = supportNames(c.scene);
  std::set<std::string> taken;
  if (c.scene.output.reactions) {
    for (const ToolSpec& tool : c.scene.tools) taken.insert(tool.name);
    for (const SceneMeasureSpec& measure : c.scene.measures) taken.insert(measure.name);
    for (const BodySpec& body : c.scene.bodies) taken.insert(body.name);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string path = fmt::format("supports[{}]", i);
    if (!taken.insert(names[i]).second && c.clean(path))
      c.report(path, fmt::format("found the name {}, which another support, a body, a tool or a measure "
                                 "has; allowed: a name of its own (name: ...).",
                                 names[i]));
  }
}

void checkLoad(const CheckContext& c, const std::string& path, const LoadSpec& load) {
  std::vector<std::string> given;
  if (!load.traction.empty()) given.emplace_back("traction");
  if (load.pressure) given.emplace_back("pressure");
  if (load.shear) given.emplace_back("shear");
  if (!load.bodyForce.empty()) given.emplace_back("body_force");
  if (given.size() != 1 && c.clean(path))
    c.report(path, fmt::format("found {}; allowed: exactly one of traction, pressure, shear and body_force.",
                               given.empty() ? "no load" : fmt::format("{}", fmt::join(given, " and "))));
  if (load.bodyForce.empty())
    checkFace(c, path, load.place);
  else if (!load.place.face.empty() || !load.place.part.empty() || !load.place.length.empty())
    c.report(path, "found a face beside body_force; allowed: at most the body and patch on which it acts.");
  else if (!load.place.patch.empty())
    checkPatch(c, path, load.place.body, load.place.patch);
  else
    checkBodyName(c, path, load.place.body);
  for (std::size_t d = 0; d < load.traction.size(); ++d)
    checkFormula(c, fmt::format("{}.traction[{}]", path, d), load.traction[d]);
  for (std::size_t d = 0; d < load.bodyForce.size(); ++d)
    checkFormula(c, fmt::format("{}.body_force[{}]", path, d), load.bodyForce[d]);
  if (load.pressure) checkFormula(c, path + ".pressure", *load.pressure);
  if (load.shear) checkFormula(c, path + ".shear", *load.shear);
  if (load.shear && c.dimensionIsKnown() && c.scene.dim() == 3)
    c.report(path + ".shear",
             "found a load of two-dimensional bodies; allowed here: traction, pressure and body_force.");
  if (load.schedule && c.clean(path + ".schedule")) checkSchedule(c, path + ".schedule", *load.schedule);
}

using PlaceOfFace = std::tuple<std::size_t, std::string, std::string>;

PlaceOfFace placeOfFace(const Scene& scene, const FaceSpec& face) {
  return {scene.bodyNumber(face.body), face.patch, face.face};
}

void checkGapLimit(const CheckContext& c, const ContactOptions& options, const std::string& path,
                   const ToolSpec* tool = nullptr) {
  if (!options.gapLimit || !c.clean(path)) return;
  if (!averagesGaps(options.method))
    return c.report(
        path, fmt::format("found with method {}, which averages no gaps; allowed: with "
                          "augmented-lagrangian and penalty.",
                          options.method == Enforcement::PointwisePenalty ? "pointwise-penalty"
                                                                          : "integral-augmented-lagrangian"));
  if (tool != nullptr && tool->carry)
    c.report(path, "found for a tool that carries a load; allowed: for tools whose motion is given.");
}

void checkFriction(const CheckContext& c, const ContactOptions& options, const std::string& path) {
  if (!options.rough) checkFrictionFormula(c, path + ".friction", options);
  if (options.rough && options.friction && c.clean(path + ".rough"))
    c.report(path + ".rough", "found beside friction; allowed: one of the two.");
  if (options.shearLimit && !options.friction && c.clean(path + ".shear_limit"))
    c.report(path + ".shear_limit", "found without friction; allowed: beside friction.");
}

void checkSegments(const CheckContext& c, const ContactSpec& pair, const std::string& path) {
  const bool isInSpace = c.dimensionIsKnown() && c.scene.dim() == 3;
  if (pair.segments && c.clean(path) &&
      (!pair.tool.empty() || isInSpace || pair.options.method == Enforcement::PointwisePenalty))
    c.report(path,
             "found true; allowed: beside against, in scenes of two dimensions, with other methods than "
             "pointwise-penalty.");
}

/// What there is to say of a pair of faces alone. faces: of all pairs before, slave and master.
void checkPair(const CheckContext& c, const ContactSpec& pair, const std::string& path,
               std::vector<std::pair<PlaceOfFace, PlaceOfFace>>& faces) {
  for (std::size_t k = 0; k < pair.against.size(); ++k)
    checkFace(c, againstKey(pair, path, k), pair.against[k]);
  if (!pair.tool.empty() && c.clean(path + ".tool"))
    c.report(path + ".tool", "found beside against; allowed: one of the two.");
  checkSegments(c, pair, path + ".segments");
  checkGapLimit(c, pair.options, path + ".gap_limit");
  checkFriction(c, pair.options, path);
  if (!c.clean(path)) return;
  const PlaceOfFace slave = placeOfFace(c.scene, pair.place);
  const std::size_t numBefore = faces.size();
  for (std::size_t k = 0; k < pair.against.size(); ++k) {
    const FaceSpec& against = pair.against[k];
    const PlaceOfFace master = placeOfFace(c.scene, against);
    if (slave == master)
      return c.report(againstKey(pair, path, k),
                      fmt::format("found face {} itself; allowed: another face, or the key self_contact.",
                                  pair.place.face));
    for (std::size_t other = 0; other < faces.size(); ++other) {
      const auto& [otherSlave, otherMaster] = faces[other];
      if (otherSlave == slave && otherMaster == master)
        return c.report(
            other < numBefore ? path : againstKey(pair, path, k),
            other < numBefore
                ? fmt::format("found the pair of faces {} and {} a second time; allowed: each pair once.",
                              pair.place.face, against.face)
                : fmt::format("found face {} a second time; allowed: each face once.", against.face));
      if (otherSlave == master && otherMaster == slave)
        return c.report(path,
                        fmt::format("found the faces {} and {} of another pair with their parts changed, so "
                                    "that both would carry multipliers; allowed: one pair, with the finer "
                                    "face named first.",
                                    pair.place.face, against.face));
    }
    faces.emplace_back(slave, master);
  }
}

void checkContact(const CheckContext& c, const std::vector<std::string>& toolNames) {
  std::set<std::tuple<std::string, std::size_t, std::string, std::string>> pairs;
  std::vector<std::pair<PlaceOfFace, PlaceOfFace>> faces;
  for (std::size_t i = 0; i < c.scene.contact.size(); ++i) {
    const ContactSpec& pair = c.scene.contact[i];
    const std::string path = fmt::format("contact[{}]", i);
    checkFace(c, path, pair.place);
    if (!pair.against.empty()) {
      checkPair(c, pair, path, faces);
      continue;
    }
    if (!c.clean(path)) continue;
    if (pair.tool.empty()) {
      c.report(path, "found neither tool nor against; required: what the face may touch, one of the two.");
      continue;
    }
    if (pair.reach && c.clean(path + ".reach"))
      c.report(path + ".reach", "found beside tool; allowed: beside against.");
    if (pair.interference != Interference::Error && c.clean(path + ".interference"))
      c.report(path + ".interference", "found beside tool; allowed: beside against.");
    checkSegments(c, pair, path + ".segments");
    const bool known = std::find(toolNames.begin(), toolNames.end(), pair.tool) != toolNames.end();
    const bool allNamesAreRead = c.clean("tools") || toolNames.size() == c.scene.tools.size();
    if (!known && allNamesAreRead)
      c.report(path + ".tool", fmt::format("found {}, but no tool has this name; allowed: {}.{}", pair.tool,
                                           toolNames.empty() ? "a tool listed under tools, which is empty"
                                                             : fmt::format("{}", fmt::join(toolNames, " | ")),
                                           didYouMean(pair.tool, toolNames)));
    const auto named = std::find_if(c.scene.tools.begin(), c.scene.tools.end(),
                                    [&](const ToolSpec& t) { return t.name == pair.tool; });
    const ToolSpec* tool = named != c.scene.tools.end() ? &*named : nullptr;
    checkGapLimit(c, pair.options, path + ".gap_limit", tool);
    checkFriction(c, pair.options, path);
    if (!pairs.insert({pair.tool, c.scene.bodyNumber(pair.place.body), pair.place.patch, pair.place.face})
             .second)
      c.report(path,
               fmt::format("found the pair of tool {} and face {} a second time; allowed: each pair once.",
                           pair.tool, pair.place.face));
  }
}

/// The list of several faces of one self-contact.
void checkFaces(const CheckContext& c, const std::string& path, const SelfContactSpec& spec) {
  checkPatch(c, path, spec.place.body, spec.place.patch);
  if (!spec.place.face.empty() && c.clean(path + ".face"))
    c.report(path + ".face", "found beside faces; allowed: one of the two.");
  for (std::size_t k = 0; k < spec.faces.size(); ++k) {
    const std::string& face = spec.faces[k];
    if (c.dimensionIsKnown() && c.scene.dim() == 2 && (face == "back" || face == "front"))
      c.report(fmt::format("{}.faces[{}]", path, k),
               fmt::format(
                   "found {}, a face of three-dimensional bodies; allowed here: left | right | bottom | top.",
                   face));
  }
}

void checkSelfContact(const CheckContext& c) {
  std::set<PlaceOfFace> faces;
  for (std::size_t i = 0; i < c.scene.selfContact.size(); ++i) {
    const SelfContactSpec& spec = c.scene.selfContact[i];
    const std::string path = fmt::format("self_contact[{}]", i);
    checkGapLimit(c, spec.options, path + ".gap_limit");
    checkFriction(c, spec.options, path);
    if (spec.faces.empty())
      checkFace(c, path, spec.place);
    else
      checkFaces(c, path, spec);
    if (!c.clean(path)) continue;
    for (const FaceSpec& place : spec.places())
      if (!faces.insert(placeOfFace(c.scene, place)).second)
        c.report(path, fmt::format("found face {} a second time; allowed: each face once.", place.face));
  }
}

}  // namespace

void checkFace(const CheckContext& c, const std::string& path, const FaceSpec& face, bool pointsToo) {
  checkPatch(c, path, face.body, face.patch);
  const std::string place = path + ".face";
  if (!c.dimensionIsKnown()) return;
  const int dim = c.scene.dim();
  if (c.clean(place) && face.face.empty())
    c.report(place, "missing; allowed: left | right | bottom | top, in three dimensions also back | front.");
  if (c.clean(place) && dim == 2 && (face.face == "back" || face.face == "front"))
    c.report(place,
             fmt::format(
                 "found {}, a face of three-dimensional bodies; allowed here: left | right | bottom | top.",
                 face.face));
  const auto checkPart = [&](const std::string& key, const std::vector<double>& part) {
    for (std::size_t d = 0; 2 * d + 1 < part.size(); ++d)
      if (pointsToo ? part[2 * d] > part[2 * d + 1] : part[2 * d] >= part[2 * d + 1])
        c.report(fmt::format("{}[{}]", key, 2 * d + 1),
                 fmt::format("found {} after {}; allowed: an end after the beginning.", part[2 * d + 1],
                             part[2 * d]));
  };
  const std::string length = path + ".length";
  if (!face.length.empty() && c.clean(length)) {
    if (dim == 3) return c.report(length, "found in a scene of three dimensions; allowed: part.");
    if (!face.part.empty()) return c.report(length, "found beside part; allowed: one of the two.");
    checkPart(length, face.length);
  }
  const std::string part = path + ".part";
  if (face.part.empty() || !c.clean(part)) return;
  if (face.part.size() != static_cast<std::size_t>(2 * (dim - 1)))
    return c.report(
        part, fmt::format("found {} numbers; allowed: {}, begin and end for each direction of the face.",
                          face.part.size(), 2 * (dim - 1)));
  checkPart(part, face.part);
}

void checkBoundary(const CheckContext& c) {
  for (std::size_t i = 0; i < c.scene.supports.size(); ++i)
    checkSupport(c, fmt::format("supports[{}]", i), c.scene.supports[i]);
  checkSupportNames(c);
  for (std::size_t i = 0; i < c.scene.loads.size(); ++i)
    checkLoad(c, fmt::format("loads[{}]", i), c.scene.loads[i]);
  checkContact(c, checkTools(c));
  checkSelfContact(c);
}

}  // namespace burnish::inline scene
