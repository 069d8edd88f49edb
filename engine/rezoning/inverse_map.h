#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/closest_point.h"
#include "engine/nurbs/patch.h"

namespace burnish {

/// The parameters of positions in a patch of the plane.
class InverseMap {
 public:
  explicit InverseMap(Patch<2> patch);

  /// The point of the patch at a position, from a guess, or from the nearest of the samples where that does
  /// not arrive. Of a position outside the patch a point of the boundary nearby, and the distance to it.
  ClosestPoint<2> operator()(const Eigen::Vector2d& position, const Eigen::Vector2d& guess) const;

 private:
  struct Sample {
    Eigen::Vector2d xi, position;
  };

  Patch<2> patch_;
  double size_;
  std::vector<Sample> samples_;  ///< the middles of all spans
};

}  // namespace burnish
