#include "postproc/mesh/chosen_bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/nearest.h"
#include "postproc/mesh/contact_field.h"

namespace burnish {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Which bodies are chosen, by number; all keep their names and numbers.
std::vector<bool> chosenOf(const ModelRecord& model, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (!contains(model.bodies, name))
      throw Error(fmt::format(
          "body: found \"{}\"; the bodies are {}.{}", name,
          model.bodies.empty() ? "one without a name" : fmt::format("{}", fmt::join(model.bodies, ", ")),
          didYouMean(name, model.bodies)));
  std::vector<bool> chosen;
  for (const std::string& body : model.bodies) chosen.push_back(contains(names, body));
  return chosen;
}

/// New numbers of the patches that stay.
std::map<int, int> keepPatches(MeshRecord& mesh, const std::vector<bool>& chosen) {
  std::map<int, int> numbers;
  std::vector<PatchRecord> kept;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    if (!chosen[static_cast<std::size_t>(mesh.patches[p].body)]) continue;
    numbers[static_cast<int>(p)] = static_cast<int>(kept.size());
    kept.push_back(std::move(mesh.patches[p]));
  }
  mesh.patches = std::move(kept);
  return numbers;
}

void keepContact(std::vector<ContactRecord>& contact, const std::map<int, int>& patches) {
  std::erase_if(contact, [&](const ContactRecord& record) { return !patches.contains(record.patch); });
  for (ContactRecord& record : contact) record.patch = patches.at(record.patch);
}

void keepPoints(QuadratureRecord& quadrature, const std::vector<bool>& chosen) {
  if (quadrature.numPoints.size() != chosen.size()) return;
  std::vector<Eigen::Index> kept;
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    for (int q = 0; q < quadrature.numPoints[k]; ++q, ++next)
      if (chosen[k]) kept.push_back(next);
    if (!chosen[k]) quadrature.numPoints[k] = 0;
  }
  quadrature.positions = quadrature.positions(Eigen::all, kept).eval();
  for (auto& [name, field] : quadrature.fields) field.values = field.values(Eigen::all, kept).eval();
}

/// Fields that one of the bodies has.
void keepFields(std::map<std::string, FieldRecord>& fields, const std::vector<std::string>& names) {
  std::erase_if(fields, [&](const auto& field) {
    const auto& bodies = field.second.bodies;
    return !bodies.empty() && std::ranges::none_of(bodies, [&](const auto& b) { return contains(names, b); });
  });
}

}  // namespace

ModelFrame chosenBodies(const ModelRecord& model, const FrameRecord& frame,
                        const std::vector<std::string>& names) {
  const std::vector<bool> chosen = chosenOf(model, names);
  ModelFrame result{model, frame};
  std::map<int, int> patches = keepPatches(result.model.mesh, chosen);
  if (result.frame.mesh) patches = keepPatches(*result.frame.mesh, chosen);
  keepContact(result.frame.contact, patches);
  keepPoints(result.frame.quadrature, chosen);
  keepFields(result.frame.fields, names);
  keepFields(result.frame.quadrature.fields, names);
  return result;
}

FieldMesh::FieldMesh(const ModelRecord& model, const FrameRecord& frame, const std::string& field)
    : whole_(meshOf(model, frame)), parted_(isContactField(field)) {
  if (parted_) {
    with_.numNodes = whole_.numNodes;
    without_ = whole_;
    return;
  }
  const std::vector<std::string> lacking = bodiesWithout(model, frame, field);
  if (lacking.empty()) return;
  parted_ = true;
  with_.numNodes = without_.numNodes = whole_.numNodes;
  for (const PatchRecord& patch : whole_.patches) {
    const bool lacks = contains(lacking, model.bodies[static_cast<std::size_t>(patch.body)]);
    (lacks ? without_ : with_).patches.push_back(patch);
  }
}

std::vector<std::string> bodiesWithout(const ModelRecord& model, const FrameRecord& frame,
                                       const std::string& field) {
  const auto found = frame.fields.find(field.substr(0, field.find('.')));
  if (found == frame.fields.end() || found->second.bodies.empty()) return {};
  std::vector<std::string> without;
  for (const PatchRecord& patch : meshOf(model, frame).patches) {
    const std::string& body = model.bodies[static_cast<std::size_t>(patch.body)];
    if (!contains(found->second.bodies, body) && !contains(without, body)) without.push_back(body);
  }
  return without;
}

}  // namespace burnish
