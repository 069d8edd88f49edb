#pragma once
#include <Eigen/Dense>

namespace burnish {

/// Points of a disc in the plane, or of a ball in space, about the origin, for means over it.
template <int Dim>
struct GaugeRule {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> offsets;
  Eigen::VectorXd weights;  ///< sum to 1
};

/// Symmetric about the origin and the axes, and exact for polynomials of the fifth degree: four radii with 48 directions in
/// the plane, 192 points, or with 8 x 32 about the y axis in space, 1024 points. Of the halves on both sides of the origin
/// along an axis each has half of the points.
template <int Dim>
GaugeRule<Dim> gaugeRule(double radius);

}  // namespace burnish
