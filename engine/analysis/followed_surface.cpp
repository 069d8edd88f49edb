#include "engine/analysis/followed_surface.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <optional>

#include "engine/core/error.h"

namespace burnish::inline analysis {

template <int Dim>
FollowedSurface<Dim>::FollowedSurface(const Body<Dim>& body, const std::vector<FacePlace>& faces)
    : surface_(body, faces), search_(surface_) {}

template <int Dim>
Eigen::Vector3d FollowedSurface<Dim>::normalNextTo(const Eigen::Vector3d& position) const {
  const Eigen::Vector<double, Dim> x = position.head<Dim>();
  const std::optional<Foot<Dim>> foot =
      search_.nearest(surface_, x, std::numeric_limits<double>::max(), [](const Foot<Dim>&) { return true; });
  if (!foot)
    throw Error(fmt::format("its face has no point next to ({:.4g}), where the tool has its middle",
                            fmt::join(x, ", ")));
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal.head<Dim>() = foot->normal;
  return normal;
}

template class FollowedSurface<2>;
template class FollowedSurface<3>;

}  // namespace burnish::inline analysis
