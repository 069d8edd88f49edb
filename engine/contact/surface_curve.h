#pragma once
#include <Eigen/Dense>
#include <optional>
#include <utility>
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
    Eigen::Vector2d normal;      ///< unit, out of the body; at a kink along the way to what it is closest to
    bool isKink = false;         ///< the closest point stays at a kink while the position moves
  };

  /// outward: `outwardSign` of the face.
  SurfaceCurve(Patch<1, 2> curve, double outward) : curve_(std::move(curve)), outward_(outward) {}

  const Patch<1, 2>& patch() const { return curve_; }
  Point at(double xi) const { return at(curve_.basis().direction(0).findSpan(xi), xi); }

  /// Closest-point projection of a position: the place where (position - x) · dx = 0, followed from a
  /// parameter with Newton's method, or a convex kink (of a basis that is continuous only) that the position
  /// is in front of. The curve goes on beyond its ends, by the size of the last span. Nothing where that does
  /// not converge or leaves the curve.
  std::optional<Point> project(const Eigen::Vector2d& position, double start) const;

 private:
  Point at(int span, double xi) const;

  /// The point at the end of a span, if it is the closest one and a kink.
  std::optional<Point> kinkAfter(int span, const Eigen::Vector2d& position) const;

  Patch<1, 2> curve_;
  double outward_;
};

}  // namespace burnish
