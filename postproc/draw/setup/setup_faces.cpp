#include "postproc/draw/setup/setup_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/scene/patch_names.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {
namespace {

using Eigen::Vector2d;

/// Parameters of a part of a face from its begin to its end.
std::vector<double> parametersOf(const UnivariateBasis& basis, const std::vector<double>& part,
                                 int subdivision) {
  const std::vector<double> all = subdividedSpans(basis, subdivision);
  if (part.empty()) return all;
  const double begin = basis.parameterAt(part[0]), end = basis.parameterAt(part[1]);
  std::vector<double> parameters{begin};
  for (const double parameter : all)
    if (parameter > begin && parameter < end) parameters.push_back(parameter);
  parameters.push_back(end);
  return parameters;
}

Vector2d middle(const Patch<2>& patch) {
  Patch<2>::Parameter xi;
  for (int d = 0; d < 2; ++d) xi(d) = patch.basis().direction(d).parameterAt(0.5);
  return patch.position(xi);
}

}  // namespace

Vector2d FaceLine::meanNormal() const {
  return std::accumulate(outward.begin(), outward.end(), Vector2d(0, 0)).normalized();
}

SetupFaces::SetupFaces(const ModelRecord& model, const Scene& scene, int subdivision)
    : subdivision_(subdivision) {
  for (const BodySpec& body : scene.allBodies()) {
    Named& named = bodies_.emplace_back();
    named.name = body.name;
    named.patchNames = patchNames(body);
  }
  for (const PatchRecord& patch : model.mesh.patches)
    bodies_[static_cast<std::size_t>(patch.body)].patches.push_back(patchGeometry<2>(patch));
}

FaceLine SetupFaces::line(const FaceSpec& place) const {
  const Patch<2>& patch = patchNamed(place);
  const FaceId id = faceFromName<2>(place.face);
  const int fixed = id / 2, along = 1 - fixed;
  Patch<2>::Parameter xi;
  xi(fixed) = patch.basis().direction(fixed).parameterAt(id % 2);
  const auto parameters = parametersOf(patch.basis().direction(along), place.part, subdivision_);
  FaceLine line;
  for (const double parameter : parameters) {
    xi(along) = parameter;
    const Eigen::Matrix2d jacobian = patch.jacobian(xi);
    const Vector2d tangent = jacobian.col(along).normalized();
    const Vector2d out = (id % 2 == 0 ? -1.0 : 1.0) * jacobian.col(fixed);
    line.points.push_back(patch.position(xi));
    line.outward.push_back((out - out.dot(tangent) * tangent).normalized());
  }
  xi(along) = std::midpoint(parameters.front(), parameters.back());
  line.middle = patch.position(xi);
  return line;
}

Vector2d SetupFaces::middleOf(const FaceSpec& place) const {
  const auto& patches = bodyNamed(place.body).patches;
  return middle(place.patch.empty() ? patches[patches.size() / 2] : patchNamed(place));
}

std::string SetupFaces::nameOf(const FaceSpec& place) const {
  std::string name = place.face;
  if (bodyNamed(place.body).patchNames.size() > 1) name += fmt::format(" of {}", place.patch);
  if (bodies_.size() > 1) name += fmt::format(" of {}", place.body);
  return name;
}

std::vector<SetupFaces::Label> SetupFaces::labels(bool ofPatches) const {
  std::vector<Label> labels;
  for (const Named& body : bodies_) {
    if (ofPatches && !body.patchNames.empty()) {
      for (std::size_t p = 0; p < body.patchNames.size(); ++p)
        labels.push_back({body.patchNames[p], middle(body.patches[p])});
    } else if (bodies_.size() > 1) {
      labels.push_back({body.name, middle(body.patches[body.patches.size() / 2])});
    }
  }
  return labels;
}

const SetupFaces::Named& SetupFaces::bodyNamed(const std::string& name) const {
  const auto found = std::ranges::find(bodies_, name, &Named::name);
  return found == bodies_.end() ? bodies_.front() : *found;
}

const Patch<2>& SetupFaces::patchNamed(const FaceSpec& place) const {
  const Named& body = bodyNamed(place.body);
  const auto found = std::ranges::find(body.patchNames, place.patch);
  return body
      .patches[found == body.patchNames.end() ? 0
                                              : static_cast<std::size_t>(found - body.patchNames.begin())];
}

}  // namespace burnish
