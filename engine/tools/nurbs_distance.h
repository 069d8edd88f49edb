#pragma once
#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "engine/nurbs/patch.h"
#include "engine/tools/facet_tree.h"
#include "engine/tools/gap_query.h"
#include "engine/tools/surface_mesh.h"

namespace burnish::inline tools {

/// Signed distance to a NURBS curve or surface by closest-point projection: a tree over a tessellation gives
/// the start, Newton's method the point.
///
/// Terminology: a *piece* is a box of parameters between kinks (knots at which the patch is continuous only),
/// inside of which it is smooth; an end of the patch in a direction is *joined* if the patch closes there.
template <int P>
class NurbsDistance {
 public:
  /// Throws `Error` for a patch without extent.
  NurbsDistance(Patch<P, 3> patch, bool flip);

  GapQuery query(const Eigen::Vector3d& x) const;

  SurfaceMesh outline() const;
  double halfThickness() const;

 private:
  using Parameter = Eigen::Vector<double, P>;
  using Index = std::array<int, P>;
  using Tangents = Eigen::Matrix<double, 3, P>;

  /// The spans [first, last] of a direction between two kinks.
  struct Interval {
    int first, last;
    double begin, end;
  };
  struct Local {
    Eigen::Vector3d y;
    Tangents dy;
    std::array<std::array<Eigen::Vector3d, P>, P> ddy;
  };
  /// A point of the patch, seen from one piece.
  struct Foot {
    Index piece;
    Parameter xi;
    Local local;
    std::array<int, P> held{};  ///< -1, +1: the closest point lies beyond that end of the piece; else 0
    double distance = 0.0;
    double residual = 0.0;  ///< largest part of y - x along a tangent that is not held
  };

  void findIntervals();
  std::vector<double> cutsOf(int direction, const Interval& interval) const;
  void tessellate();
  bool isJoined(int direction) const;
  bool isCollapsed(FaceId face) const;
  std::vector<int> faceLayer(FaceId face) const;

  Local evaluate(const Index& piece, const Parameter& xi) const;
  Eigen::Vector3d outward(const Local& local) const;

  Foot start(const Eigen::Vector3d& x) const;
  void look(Foot& foot, const Eigen::Vector3d& x) const;
  void project(Foot& foot, const Eigen::Vector3d& x) const;
  Parameter stepFrom(const Foot& foot, const Eigen::Vector3d& x, bool coupled) const;
  bool goAlong(Foot& foot, const Parameter& step, const Eigen::Vector3d& x) const;

  /// The same point seen from the piece beyond the end at which it is held; nothing beyond a rim.
  std::optional<Foot> across(const Foot& foot, int direction) const;
  Foot closest(const Eigen::Vector3d& x) const;

  GapQuery smoothGap(const Foot& foot, const Eigen::Vector3d& x) const;
  GapQuery cornerGap(const Foot& foot, const Eigen::Vector3d& x) const;
  int partOf(const Foot& foot) const;
  Eigen::Vector3d meanNormal(const Foot& foot) const;
  bool isAtRim(const Foot& foot) const;

  Patch<P, 3> patch_;
  double side_;
  double size_ = 0.0;
  std::array<std::vector<Interval>, P> intervals_;
  std::array<bool, P> joined_{};
  std::vector<Index> cellPieces_;
  std::vector<Parameter> parameters_;  ///< of the points of the tessellation
  SurfaceMesh mesh_;                   ///< one piece after the other, points at kinks several times
  std::optional<FacetTree> tree_;
};

}  // namespace burnish::inline tools
