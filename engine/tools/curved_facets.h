#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/tools/facet_tree.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// Signed distance to a surface of straight pieces, each bent to a quadratic patch (after Nagata 2005) by the
/// normals in its corners, so that a fine mesh of a round body is round. Normals are means over the pieces
/// around a corner, with Max's weights, which are exact for points on a sphere or circle; across creases of
/// more than 30 degrees each side keeps its own. Beyond a rim the surface goes on straight.
class CurvedFacets {
 public:
  /// normals: those that are known, as columns for the corners of each cell, in the order of the cells; zero columns,
  /// and all if there is no entry, are found.
  explicit CurvedFacets(SurfaceMesh surface, std::vector<Eigen::Matrix3d> normals = {});

  const SurfaceMesh& surface() const { return surface_; }

  struct Answer {
    double gap = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit
  };
  Answer query(const Eigen::Vector3d& x) const;

 private:
  /// A point of a patch.
  struct Foot {
    Eigen::Index cell = 0;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the corners, sum 1
    Eigen::Vector3d y = Eigen::Vector3d::Zero();
    double distance = 0.0;
  };

  Eigen::Vector3d facetNormal(Eigen::Index cell) const;
  Eigen::Vector3d cornerNormal(Eigen::Index cell, int corner) const;
  Eigen::Vector3d fanNormal(Eigen::Index cell, int corner) const;
  void findNeighbours();
  void findNormals();
  void findBends();
  bool isCrease(Eigen::Index cell, Eigen::Index neighbour) const;

  int edgeBegin(int edge) const { return edge; }
  int edgeEnd(int edge) const { return (edge + 1) % corners_; }
  int numEdges() const { return corners_ == 2 ? 1 : 3; }

  Eigen::Vector3d position(Eigen::Index cell, const Eigen::Vector3d& weights) const;
  Eigen::Matrix<double, 3, 2> tangents(Eigen::Index cell, const Eigen::Vector3d& weights) const;
  Foot footAt(Eigen::Index cell, const Eigen::Vector3d& weights, const Eigen::Vector3d& x) const;
  Foot onEdge(Eigen::Index cell, int edge, const Eigen::Vector3d& start, const Eigen::Vector3d& x) const;
  bool inside(Foot& foot, const Eigen::Vector3d& x) const;
  Foot closestOf(Eigen::Index cell, const Eigen::Vector3d& near, const Eigen::Vector3d& x) const;
  Answer answerAt(const Foot& foot, const Eigen::Vector3d& x) const;

  SurfaceMesh surface_;
  int corners_;                           ///< 2 or 3
  Eigen::MatrixXi neighbours_;            ///< beyond edge k (2D: beyond corner k) of a cell; -1 at a rim
  std::vector<Eigen::Matrix3d> normals_;  ///< per cell, columns: at its corners
  std::vector<Eigen::Matrix3d> bends_;    ///< per cell, columns c_k: the edge is a + t (b - a) - c t (1 - t)
  std::vector<Eigen::Vector3d> means_;    ///< per point: mean normal over all sides, weighted by angles
  std::vector<bool> isAtRim_;             ///< per point
  FacetTree tree_;
};

}  // namespace burnish::inline tools
