#pragma once
#include <Eigen/Dense>
#include <vector>

#include "engine/nurbs/closest_point.h"
#include "engine/nurbs/patch.h"

namespace burnish::inline nurbs {

/// The parameters of positions in a patch.
template <int Dim>
class InverseMap {
 public:
  using Point = Eigen::Vector<double, Dim>;

  explicit InverseMap(Patch<Dim> patch);

  const Patch<Dim>& patch() const { return patch_; }

  /// Largest extent of the bounding box of the control points.
  double size() const { return size_; }

  /// The point of the patch at a position, from a guess, or from the nearest of the samples where that does
  /// not arrive. Of a position outside the patch a point of the boundary nearby, and the distance to it.
  ClosestPoint<Dim> operator()(const Point& position, const Point& guess) const;

  /// Whether the point that was found is at its position, up to rounding.
  bool arrived(const ClosestPoint<Dim>& found) const;

 private:
  struct Sample {
    Point xi, position;
  };

  Patch<Dim> patch_;
  double size_;
  std::vector<Sample> samples_;  ///< the middles of all spans
};

}  // namespace burnish::inline nurbs
