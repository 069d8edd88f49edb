#include "engine/tools/faceted_shape.h"

#include <limits>
#include <utility>

#include "engine/tools/faceted_distance.h"

namespace burnish {

GapQuery FacetedShape::query(const Eigen::Vector3d& x) const {
  return distance->query(x);
}

FacetedShape makeFacetedShape(SurfaceMesh surface, std::optional<double> smoothing) {
  return {std::make_shared<const FacetedDistance>(std::move(surface), smoothing)};
}

const SurfaceMesh& outlineOf(const FacetedShape& shape) {
  return shape.distance->surface();
}

double halfThicknessOf(const FacetedShape& shape) {
  const SurfaceMesh& surface = outlineOf(shape);
  if (!surface.closed) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d extent = surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff();
  return 0.5 * extent.head(surface.cells.rows()).minCoeff();
}

}  // namespace burnish
