#include "postproc/draw/setup/setup_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

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

}  // namespace

Vector2d FaceLine::meanNormal() const {
  return std::accumulate(outward.begin(), outward.end(), Vector2d(0, 0)).normalized();
}

SetupFaces::SetupFaces(const ModelRecord& model, const Scene& scene, int subdivision)
    : subdivision_(subdivision) {
  for (const PatchRecord& patch : model.mesh.patches) patches_.push_back(patchGeometry<2>(patch));
  if (const auto* several = std::get_if<PatchesSpec>(&scene.geometry.shape))
    for (const PatchSpec& patch : several->patches) names_.push_back(patch.name);
}

FaceLine SetupFaces::line(const FaceSpec& place) const {
  const Patch<2>& patch = patchNamed(place.patch);
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

Vector2d SetupFaces::middleOf(const std::string& patch) const {
  const Patch<2>& found = patch.empty() ? patches_[patches_.size() / 2] : patchNamed(patch);
  Patch<2>::Parameter xi;
  for (int d = 0; d < 2; ++d) xi(d) = found.basis().direction(d).parameterAt(0.5);
  return found.position(xi);
}

std::string SetupFaces::nameOf(const FaceSpec& place) const {
  return names_.size() < 2 ? place.face : fmt::format("{} of {}", place.face, place.patch);
}

const Patch<2>& SetupFaces::patchNamed(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return patches_[found == names_.end() ? 0 : static_cast<std::size_t>(found - names_.begin())];
}

}  // namespace burnish
