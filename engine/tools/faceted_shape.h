#pragma once
#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "engine/tools/gap_query.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

class FacetedDistance;

/// Tool bounded by straight pieces: triangles, or segments in 2D. Its gap is a smooth function.
struct FacetedShape {
  std::shared_ptr<const FacetedDistance> distance;

  GapQuery query(const Eigen::Vector3d& x) const;

  /// Half the smallest extent of a closed surface, infinity for an open one.
  double halfThickness() const;

  /// See `FacetedDistance::bulge`.
  double bulge() const;
  Eigen::Vector3d middle() const;

  /// The pieces themselves.
  SurfaceMesh outline(int dim, double reach) const;
};

/// `surface`: without degenerate pieces, each oriented like its neighbours (see `readSurface`). `smoothing`:
/// spacing of the grid on which the gap is interpolated; when left out the median length of an edge, at most
/// 1/32 of the smallest extent.
FacetedShape makeFacetedShape(SurfaceMesh surface, std::optional<double> smoothing = {});

/// Of the key `smoothing` of shapes that are made of pieces.
inline constexpr const char* kSmoothingSentence =
    "Spacing of the grid on which the distance is made smooth, and about the radius that sharp edges get; "
    "when left out the typical length of an edge, at most 1/32 of the smallest extent, of an open surface "
    "1/256 of the largest.";

}  // namespace burnish::inline tools
