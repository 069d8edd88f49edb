#include "postproc/probe/body_locator.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "engine/core/error.h"
#include "postproc/mesh/patch_geometry.h"

namespace burnish {

template <int Dim>
BodyLocator<Dim>::BodyLocator(const MeshRecord& mesh, const Eigen::MatrixXd& displacement) : mesh_(mesh) {
  for (const PatchRecord& record : mesh.patches) {
    const Patch<Dim>& patch = maps_.emplace_back(patchGeometry<Dim>(record, displacement)).patch();
    const Point low = patch.points().rowwise().minCoeff(), high = patch.points().rowwise().maxCoeff();
    const double margin = kLagrangeBulge * maps_.back().size();
    around_.emplace_back(Point(low.array() - margin), Point(high.array() + margin));
  }
}

template <int Dim>
std::optional<MeshPlace<Dim>> BodyLocator<Dim>::find(const Point& position,
                                                     const std::optional<MeshPlace<Dim>>& guess) const {
  if (guess)
    if (const auto place = inPatch(guess->patch, position, guess->xi)) return place;
  for (std::size_t p = 0; p < maps_.size(); ++p)
    if (!guess || p != guess->patch)
      if (const auto place = inPatch(p, position, middle(p))) return place;
  return std::nullopt;
}

template <int Dim>
typename BodyLocator<Dim>::Nearest BodyLocator<Dim>::nearest(const Point& position,
                                                             std::optional<int> body) const {
  Nearest best{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t p = 0; p < maps_.size(); ++p) {
    if (body && mesh_.patches[p].body != *body) continue;
    const ClosestPoint<Dim> found = maps_[p](position, middle(p));
    if (found.distance < best.distance) best = {{p, found.xi}, found.distance};
  }
  return best;
}

template <int Dim>
std::optional<MeshPlace<Dim>> BodyLocator<Dim>::inPatch(std::size_t patch, const Point& position,
                                                        const Point& guess) const {
  if (!around_[patch].contains(position)) return std::nullopt;
  const ClosestPoint<Dim> found = maps_[patch](position, guess);
  if (!maps_[patch].arrived(found)) return std::nullopt;
  return MeshPlace<Dim>{patch, found.xi};
}

template <int Dim>
typename BodyLocator<Dim>::Point BodyLocator<Dim>::middle(std::size_t patch) const {
  return parameterGrid(maps_[patch].patch().basis(), {0.5}).front();
}

template <int Dim>
Eigen::AlignedBox<double, Dim> BodyLocator<Dim>::box() const {
  Eigen::AlignedBox<double, Dim> box;
  for (const InverseMap<Dim>& map : maps_)
    for (const Point& xi : parameterGrid(map.patch().basis(), {0.0, 0.25, 0.5, 0.75, 1.0}))
      box.extend(map.patch().position(xi));
  return box;
}

template <int Dim>
ProbePoint BodyLocator<Dim>::point(double at, const MeshPlace<Dim>& place, const FrameRecord& frame,
                                   const ProbedFields& fields, const std::optional<SurfaceAxes>& axes) const {
  const PatchRecord& record = mesh_.patches[place.patch];
  const Patch<Dim>& patch = maps_[place.patch].patch();
  const int span = patch.findSpan(place.xi);
  const Eigen::VectorXd R = patch.shape(span, place.xi).R;
  const std::vector<int> functions = patch.basis().spanFunctions(span);
  std::vector<int> nodes;
  for (const int a : functions) nodes.push_back(record.nodes[static_cast<std::size_t>(a)]);
  const Eigen::VectorXd reference = record.points(Eigen::all, functions) * R;
  return {at, record.body, reference + frame.displacement(Eigen::all, nodes) * R, reference,
          fields.values(record.body, nodes, R, axes)};
}

std::string pointText(const Eigen::VectorXd& point) {
  return fmt::format("({:.6g})", fmt::join(point, ", "));
}

void requireNotTooLong(const char* what, double length, double size) {
  constexpr double kLongest = 1000.0;
  if (!(length <= kLongest * size))
    throw Error(
        fmt::format("{}: found a length of {:.6g}; expected at most {} times the size of the body, {:.6g}",
                    what, length, kLongest, size));
}

double lineLength(const Eigen::VectorXd& begin, const Eigen::VectorXd& end, double size) {
  const double length = (end - begin).stableNorm();
  if (!(length > 0.0))
    throw Error(fmt::format("line: found {} twice; expected two points", pointText(begin)));
  requireNotTooLong("line", length, size);
  return length;
}

template class BodyLocator<2>;
template class BodyLocator<3>;

}  // namespace burnish
