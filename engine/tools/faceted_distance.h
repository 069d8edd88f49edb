#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/tools/curved_facets.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// Smooth signed distance to a surface of straight pieces: the C² cubic spline that quasi-interpolates the
/// distance to the curved facets on a grid. Per axis the coefficient of the B-spline at i is
/// (-f(i-1) + 8 f(i) - f(i+1)) / 6, which reproduces cubics. Coefficients are found where they are asked for
/// and kept; the answers do not depend on the order of the questions. To be asked from one thread at a time.
class FacetedDistance {
 public:
  /// normals: those that are known, see `CurvedFacets`.
  FacetedDistance(SurfaceMesh surface, std::optional<double> smoothing,
                  std::vector<Eigen::Matrix3d> normals = {});

  const SurfaceMesh& surface() const { return facets_.surface(); }

  GapQuery query(const Eigen::Vector3d& x) const;

  /// How far the smoothed surface stands out of the facets beside an edge, at most.
  double bulge() const;

 private:
  using Node = std::array<std::int64_t, 3>;
  struct NodeHash {
    std::size_t operator()(const Node& node) const;
  };

  double sample(const Node& node) const;
  double coefficient(const Node& node) const;

  CurvedFacets facets_;
  int dim_;
  double spacing_;
  mutable std::unordered_map<Node, double, NodeHash> samples_, coefficients_;
};

}  // namespace burnish::inline tools
