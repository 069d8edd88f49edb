#include "engine/tools/faceted_shape.h"

#include <limits>
#include <utility>

#include "engine/tools/faceted_distance.h"

namespace burnish::inline tools {

GapQuery FacetedShape::query(const Eigen::Vector3d& x) const {
  return distance->query(x);
}

double FacetedShape::halfThickness() const {
  const SurfaceMesh& surface = distance->surface();
  if (!surface.closed) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d extent = surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff();
  return 0.5 * extent.head(surface.cells.rows()).minCoeff();
}

double FacetedShape::bulge() const {
  return distance->bulge();
}

Eigen::Vector3d FacetedShape::middle() const {
  return middleOfBox(distance->surface());
}

SurfaceMesh FacetedShape::outline(int /*dim*/, double /*reach*/) const {
  return distance->surface();
}

FacetedShape makeFacetedShape(SurfaceMesh surface, std::optional<double> smoothing) {
  return {std::make_shared<const FacetedDistance>(std::move(surface), smoothing)};
}

}  // namespace burnish::inline tools
