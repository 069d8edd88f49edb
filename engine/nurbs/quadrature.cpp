#include "engine/nurbs/quadrature.h"

#include <cmath>
#include <numbers>

namespace burnish::inline nurbs {

QuadratureRule gaussLegendre(int n) {
  QuadratureRule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const auto order = static_cast<unsigned>(n);
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (n - i - 0.25) / (n + 0.5));  // Tricomi's start, ascending in i
    double slope = 0.0;
    for (int newton = 0; newton < 10; ++newton) {
      const double P = std::legendre(order, x);
      slope = n * (x * P - std::legendre(order - 1, x)) / (x * x - 1.0);
      const double step = P / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    slope = n * (x * std::legendre(order, x) - std::legendre(order - 1, x)) / (x * x - 1.0);
    rule.points(i) = 0.5 * (1.0 + x);
    rule.weights(i) = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace burnish::inline nurbs
