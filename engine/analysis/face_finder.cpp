#include "engine/analysis/face_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/input_error.h"
#include "engine/nurbs/quadrature.h"

namespace burnish::inline analysis {
namespace {

/// Shares of the parameter range of a curve at which it has these lengths. Throws `InputError` at `key` for
/// lengths that it does not have.
std::vector<double> sharesAt(const Patch<1, 2>& curve, const std::vector<double>& lengths,
                             const std::string& key) {
  constexpr int kPieces = 64, kPoints = 6;
  constexpr double kRounding = 1e-9;
  const UnivariateBasis& basis = curve.basis().direction(0);
  const QuadratureRule rule = gaussLegendre(kPoints);
  std::vector<double> parameters{basis.breakpoints().front()}, at{0.0};
  for (int span = 0; span < basis.numSpans(); ++span)
    for (int k = 0; k < kPieces; ++k) {
      const double width = (basis.spanEnd(span) - basis.spanBegin(span)) / kPieces;
      const double begin = basis.spanBegin(span) + k * width;
      double length = 0.0;
      for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
        const auto shape = curve.shape(span, Eigen::Vector<double, 1>(begin + rule.points(q) * width));
        const Eigen::Vector2d tangent =
            curve.points()(Eigen::all, curve.basis().spanFunctions(span)) * shape.dR;
        length += rule.weights(q) * width * tangent.norm();
      }
      parameters.push_back(begin + width);
      at.push_back(at.back() + length);
    }
  std::vector<double> shares;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    if (lengths[k] > at.back() * (1.0 + kRounding))
      throw InputError(
          fmt::format("{}[{}]", key, k),
          fmt::format("found {}; allowed: up to {:.6g}, the length of the face", lengths[k], at.back()));
    const auto next = std::upper_bound(at.begin() + 1, at.end() - 1, lengths[k]);
    const auto n = static_cast<std::size_t>(next - at.begin());
    const double s = std::min(1.0, (lengths[k] - at[n - 1]) / (at[n] - at[n - 1]));
    shares.push_back(basis.shareOf((1.0 - s) * parameters[n - 1] + s * parameters[n]));
  }
  return shares;
}

}  // namespace

template <int Dim>
FaceFinder<Dim>::FaceFinder(const Body<Dim>& body, std::vector<BodyNames> names)
    : body_(body), names_(std::move(names)) {
  for (std::size_t k = 0; k < names_.size(); ++k)
    for (const std::string& patch : names_[k].patches) patches_.push_back({k, patch});
}

template <int Dim>
int FaceFinder<Dim>::patch(const std::string& body, const std::string& name) const {
  int first = 0;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const auto& [itsName, patches] = names_[k];
    if (body.empty() || body == itsName) {
      const auto found = std::find(patches.begin(), patches.end(), name);
      return name.empty() || found == patches.end() ? first
                                                    : first + static_cast<int>(found - patches.begin());
    }
    first += static_cast<int>(patches.size());
  }
  return 0;
}

template <int Dim>
std::string FaceFinder<Dim>::textOf(const FacePlace& place) const {
  const Name& name = patches_[static_cast<std::size_t>(place.patch)];
  const BodyNames& body = names_[name.body];
  std::string text = fmt::format("'{}'", faceName(place.face));
  if (body.patches.size() > 1) text += fmt::format(" of patch '{}'", name.patch);
  if (names_.size() > 1) text += fmt::format(" of body '{}'", body.body);
  return text;
}

template <int Dim>
std::optional<std::string> FaceFinder<Dim>::neighbour(const FacePlace& place) const {
  const auto own = static_cast<std::size_t>(place.patch);
  const auto onFace = nodesOn(place);
  for (std::size_t other = 0; other < body_.patches.size(); ++other) {
    const std::set<int> theirs(body_.nodes[other].begin(), body_.nodes[other].end());
    if (other != own &&
        std::all_of(onFace.begin(), onFace.end(), [&](int node) { return theirs.contains(node); }))
      return patches_[other].patch;
  }
  return std::nullopt;
}

template <int Dim>
std::vector<OuterFace> FaceFinder<Dim>::outerFaces() const {
  std::vector<OuterFace> faces;
  for (int patch = 0; patch < static_cast<int>(patches_.size()); ++patch)
    for (FaceId face = 0; face < 2 * Dim; ++face) {
      const FacePlace place{patch, face};
      if (!neighbour(place)) faces.push_back({place, textOf(place)});
    }
  return faces;
}

template <int Dim>
void FaceFinder<Dim>::requireOuter(const FaceSpec& place, const std::string& key) const {
  if (const auto other = neighbour(face(place)))
    throw InputError(
        key,
        fmt::format(
            "face '{}' of patch '{}' is joined to patch '{}', so it lies inside the body; name an outer face",
            place.face, place.patch, *other));
}

template <int Dim>
std::vector<double> FaceFinder<Dim>::part(const FaceSpec& place, const std::string& key) const {
  if constexpr (Dim == 2)
    if (!place.length.empty()) {
      const auto& own = body_.patches[static_cast<std::size_t>(patch(place))];
      return sharesAt(tracePatch(own, faceFromName<2>(place.face)), place.length, key + ".length");
    }
  return place.part;
}

template <int Dim>
std::vector<int> FaceFinder<Dim>::nodes(const FaceSpec& place) const {
  return nodesOn(face(place));
}

template <int Dim>
std::vector<int> FaceFinder<Dim>::nodesOn(const FacePlace& place) const {
  const auto patch = static_cast<std::size_t>(place.patch);
  std::vector<int> result;
  for (const int a : faceFunctions(body_.patches[patch].basis(), place.face))
    result.push_back(body_.nodes[patch][static_cast<std::size_t>(a)]);
  return result;
}

template class FaceFinder<2>;
template class FaceFinder<3>;

}  // namespace burnish::inline analysis
