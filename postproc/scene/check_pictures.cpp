#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "engine/core/nearest.h"
#include "postproc/scene/document_context.h"
#include "postproc/scene/scene_fields.h"

namespace burnish {
namespace {

bool materialsAreClean(const CheckContext& c) {
  if (!c.bodiesAreRead()) return false;
  for (std::size_t k = 0; k < c.scene.allBodies().size(); ++k)
    if (!c.clean(c.scene.bodyKey(k, "material"))) return false;
  return true;
}

/// Faces with the quadrature points of a contact, and what they touch.
struct ContactFaces {
  std::vector<FaceSpec> slaves;
  std::vector<FaceSpec> masters;  ///< of pairs
};

ContactFaces contactFacesOf(const Scene& scene) {
  ContactFaces result;
  for (const ContactSpec& contact : scene.contact) {
    result.slaves.push_back(contact.place);
    for (const FaceSpec& face : contact.against) result.masters.push_back(face);
  }
  for (const SelfContactSpec& contact : scene.selfContact)
    for (const FaceSpec& face : contact.places()) result.slaves.push_back(face);
  return result;
}

bool contactIsRead(const CheckContext& c) {
  return c.clean("contact") && c.clean("self_contact");
}

/// Whether a probe's face may be one of these.
bool isAmong(const std::vector<FaceSpec>& faces, const ProbeSpec& probe) {
  return std::ranges::any_of(faces, [&](const FaceSpec& face) {
    const bool ofBody = probe.bodies.empty() || std::ranges::count(probe.bodies, face.body) > 0;
    return face.face == probe.face && ofBody &&
           (probe.patch.empty() || face.patch.empty() || face.patch == probe.patch);
  });
}

/// A probe of contact fields lies along a face that has them.
void checkContactFace(const CheckContext& c, const std::string& path, const ProbeSpec& probe) {
  const std::string key = path + ".face";
  if (probe.face.empty() || !std::ranges::any_of(probe.fields, isContactField) || !c.clean(key) ||
      !contactIsRead(c))
    return;
  const ContactFaces faces = contactFacesOf(c.scene);
  if (faces.slaves.empty() || isAmong(faces.slaves, probe)) return;
  std::vector<std::string> known;
  for (const FaceSpec& face : faces.slaves)
    known.push_back(face.face + (face.body.empty() ? "" : " of " + face.body));
  c.report(key, fmt::format("found {}, {}; allowed for contact fields: {}.", probe.face,
                            isAmong(faces.masters, probe)
                                ? "which a pair has as against; the other face has its contact fields"
                                : "which is in no contact",
                            fmt::join(known, ", ")));
}

/// Fields that these bodies, their materials and their contact have not.
void checkField(const CheckContext& c, const std::string& path, const std::string& field) {
  if (!c.clean(path)) return;
  const auto reportIf = [&](bool isKnown, const auto& problem) {
    if (!isKnown) return;
    if (const std::string text = problem(); !text.empty()) c.report(path, text);
  };
  reportIf(c.dimensionIsKnown(), [&] { return componentProblem(c.scene.dim(), field); });
  reportIf(materialsAreClean(c), [&] { return lawProblem(c.scene, field); });
  reportIf(contactIsRead(c), [&] { return contactProblem(c.scene, field); });
}

/// What options say that cannot be.
void checkOptions(const CheckContext& c, const std::string& path, const PictureOptions& picture) {
  const auto dim = c.dimensionIsKnown() ? std::optional(c.scene.dim()) : std::nullopt;
  for (const InputProblem& problem : conflictsIn(picture, dim))
    if (const std::string key = path + "." + problem.path; c.clean(key)) c.report(key, problem.text);
}

/// The same of a picture for print.
void checkPrint(const CheckContext& c, const std::string& path, const ScenePicture& picture) {
  if (!picture.isForPrint()) {
    for (const InputProblem& problem : printOptionsOfPixels(picture))
      if (const std::string key = path + "." + problem.path; c.clean(key)) c.report(key, problem.text);
    return;
  }
  const std::string key = path + ".dpi";
  for (const InputProblem& problem : printConflictsIn(picture))
    if (c.clean(key) && c.clean(path + ".size")) c.report(key, problem.text);
}

/// chosen: names of bodies.
void checkBodyNames(const CheckContext& c, const std::string& path, const std::vector<std::string>& chosen) {
  if (!c.bodiesAreRead()) return;
  std::vector<std::string> names;
  for (const BodySpec& body : c.scene.bodies) names.push_back(body.name);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::string& name = chosen[k];
    if (const std::string key = fmt::format("{}.body[{}]", path, k);
        c.clean(key) && std::find(names.begin(), names.end(), name) == names.end())
      c.report(key, fmt::format("found {}; allowed: {}.{}", name,
                                names.empty() ? "leave the key out, the one body of the scene has no name"
                                              : fmt::format("{}", fmt::join(names, " | ")),
                                didYouMean(name, names)));
  }
}

void requireNew(const CheckContext& c, const std::string& path, const std::string& name,
                std::set<std::string>& names) {
  if (names.insert(name).second) return;
  c.report(path,
           fmt::format(
               "found the file name {} a second time; allowed: a name of its own for each entry (name: ...).",
               name));
}

}  // namespace

void checkPictures(const DocumentContext& c) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.document.pictures.size(); ++i) {
    const ScenePicture& picture = c.document.pictures[i];
    const std::string path = fmt::format("pictures[{}]", i);
    checkField(c, path + ".field", picture.field);
    if (c.clean("steps")) checkTimes(c, path + ".times", picture.times);
    checkOptions(c, path, picture);
    if (picture.threshold) checkField(c, path + ".threshold", picture.threshold->field);
    if (picture.isosurfaces) checkField(c, path + ".isosurfaces", picture.isosurfaces->field);
    checkPrint(c, path, picture);
    checkBodyNames(c, path, picture.bodies);
    if (c.clean(path)) requireNew(c, path, picture.name.value_or(picture.field), names);
  }
}

void checkProbes(const DocumentContext& c) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.document.probes.size(); ++i) {
    const SceneProbe& probe = c.document.probes[i];
    const std::string path = fmt::format("probes[{}]", i);
    for (std::size_t k = 0; k < probe.fields.size(); ++k)
      checkField(c, fmt::format("{}.field[{}]", path, k), probe.fields[k]);
    if (c.clean("steps")) checkTimes(c, path + ".times", probe.times);
    for (const InputProblem& problem : conflictsIn(probe))
      if (const std::string key = path + "." + problem.path; c.clean(key)) c.report(key, problem.text);
    checkContactFace(c, path, probe);
    if (probe.isOverTime() && !probe.times.empty() && c.clean(path + ".times"))
      c.report(path + ".times", "found times of values over time; allowed: none.");
    checkBodyNames(c, path, probe.bodies);
    if (c.clean(path)) requireNew(c, path, probe.name, names);
  }
}

}  // namespace burnish
