#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/nurbs/patch.h"

namespace burnish {

/// The surface of a plane body along one of its faces, in its present place.
class SurfaceCurve {
 public:
  /// A point with what the second variation of a distance to it needs.
  struct Point {
    double xi = 0.0;
    std::vector<int> functions;  ///< of the curve, n
    Eigen::VectorXd R, dR;       ///< n: values and derivatives with respect to the parameter
    Eigen::Vector2d x, dx, ddx;  ///< position and derivatives
    Eigen::Vector2d normal;      ///< unit, out of the body
  };

  /// outward: 1 if the normal out of the body is on the right of the curve, -1 if on its left.
  SurfaceCurve(Patch<1, 2> curve, double outward) : curve_(std::move(curve)), outward_(outward) {}

  const Patch<1, 2>& patch() const { return curve_; }
  Point at(double xi) const;

  /// The point nearest to a position, followed from a parameter with Newton's method on
  /// (position - x) · dx = 0. The curve goes on beyond its ends, by the size of the last span. Nothing where
  /// that does not converge or leaves the curve.
  std::optional<Point> nearest(const Eigen::Vector2d& position, double start) const;

 private:
  Patch<1, 2> curve_;
  double outward_;
};

}  // namespace burnish
