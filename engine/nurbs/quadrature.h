#pragma once
#include <Eigen/Dense>

namespace burnish::inline nurbs {

/// A quadrature rule on [0, 1].
struct QuadratureRule {
  Eigen::VectorXd points;
  Eigen::VectorXd weights;  ///< sum to 1
};

/// Gauss-Legendre rule with n >= 1 points, exact for polynomials of degree 2n-1.
QuadratureRule gaussLegendre(int n);

}  // namespace burnish::inline nurbs
