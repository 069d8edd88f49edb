#pragma once
#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "engine/tools/gap_query.h"
#include "engine/tools/surface_mesh.h"

namespace burnish {

class FacetedDistance;

/// Tool bounded by straight pieces: triangles, or segments in 2D. Its gap is a smooth function.
struct FacetedShape {
  std::shared_ptr<const FacetedDistance> distance;
  GapQuery query(const Eigen::Vector3d& x) const;
};

/// `surface`: without degenerate pieces, each oriented like its neighbours (see `readSurface`). `smoothing`:
/// spacing of the grid on which the gap is interpolated; when left out the median length of an edge, at most
/// 1/32 of the smallest extent.
FacetedShape makeFacetedShape(SurfaceMesh surface, std::optional<double> smoothing = {});

const SurfaceMesh& outlineOf(const FacetedShape& shape);

/// Half the smallest extent of a closed surface, infinity for an open one.
double halfThicknessOf(const FacetedShape& shape);

}  // namespace burnish
