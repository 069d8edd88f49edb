#pragma once
#include <Eigen/Dense>

#include "engine/nurbs/patch.h"

namespace burnish {

/// The parameters of positions in a patch of the plane.
class InverseMap {
 public:
  explicit InverseMap(Patch<2> patch);

  /// Parameters of a position, by Newton's method from a guess, or from the nearest of the samples where that
  /// does not arrive. A position outside the patch gets the parameters of a point of the boundary nearby.
  Eigen::Vector2d operator()(const Eigen::Vector2d& position, const Eigen::Vector2d& guess) const;

 private:
  struct Found {
    Eigen::Vector2d xi;
    double distance;
  };

  Found newton(const Eigen::Vector2d& position, Eigen::Vector2d xi) const;
  Eigen::Vector2d clamped(const Eigen::Vector2d& xi) const;

  Patch<2> patch_;
  double size_;
  Eigen::Matrix2Xd parameters_, positions_;  ///< of the middles of all spans
};

}  // namespace burnish
