#include "engine/analysis/face_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/input_error.h"
#include "engine/nurbs/quadrature.h"

namespace burnish {
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
int FaceFinder<Dim>::patch(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return name.empty() || found == names_.end() ? 0 : static_cast<int>(found - names_.begin());
}

template <int Dim>
std::optional<std::string> FaceFinder<Dim>::neighbour(const FaceSpec& place) const {
  const auto own = static_cast<std::size_t>(patch(place.patch));
  const auto onFace = nodes(place);
  for (std::size_t other = 0; other < body_.patches.size(); ++other) {
    const std::set<int> theirs(body_.nodes[other].begin(), body_.nodes[other].end());
    if (other != own &&
        std::all_of(onFace.begin(), onFace.end(), [&](int node) { return theirs.contains(node); }))
      return names_[other];
  }
  return std::nullopt;
}

template <int Dim>
std::vector<OuterFace> FaceFinder<Dim>::outerFaces() const {
  std::vector<OuterFace> faces;
  for (std::size_t patch = 0; patch < names_.size(); ++patch)
    for (FaceId face = 0; face < 2 * Dim; ++face) {
      const std::string name = faceName(face);
      if (neighbour({names_[patch], name, {}})) continue;
      faces.push_back({{static_cast<int>(patch), face},
                       names_.size() == 1 ? fmt::format("'{}'", name)
                                          : fmt::format("'{}' of patch '{}'", name, names_[patch])});
    }
  return faces;
}

template <int Dim>
void FaceFinder<Dim>::requireOuter(const FaceSpec& place, const std::string& key) const {
  if (const auto other = neighbour(place))
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
      const auto& own = body_.patches[static_cast<std::size_t>(patch(place.patch))];
      return sharesAt(tracePatch(own, faceFromName<2>(place.face)), place.length, key + ".length");
    }
  return place.part;
}

template <int Dim>
std::vector<int> FaceFinder<Dim>::functions(const FaceSpec& place) const {
  return faceFunctions(body_.patches[static_cast<std::size_t>(patch(place.patch))].basis(),
                       faceFromName<Dim>(place.face));
}

template <int Dim>
std::vector<int> FaceFinder<Dim>::nodes(const FaceSpec& place) const {
  std::vector<int> result;
  const auto& nodes = body_.nodes[static_cast<std::size_t>(patch(place.patch))];
  for (const int a : functions(place)) result.push_back(nodes[static_cast<std::size_t>(a)]);
  return result;
}

template class FaceFinder<2>;
template class FaceFinder<3>;

}  // namespace burnish
