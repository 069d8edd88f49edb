#pragma once
#include <cmath>

namespace burnish::inline material {

/// Volumetric part U(J) of an elastic law.
struct VolumetricResponse {
  double logJ;
  double pressure;   ///< mean Kirchhoff stress J U'
  double stiffness;  ///< its derivative with respect to ln J
  double energy;

  /// U = κ/2 (½(J² − 1) − ln J).
  static VolumetricResponse squared(double kappa, double JMinusOne) {
    const double logJ = std::log1p(JMinusOne);
    const double halfJ2 = JMinusOne * (1.0 + 0.5 * JMinusOne);  // ½(J² − 1)
    return {logJ, kappa * halfJ2, kappa * (1.0 + 2.0 * halfJ2), 0.5 * kappa * (halfJ2 - logJ)};
  }

  /// U = κ/2 (ln J)².
  static VolumetricResponse logarithmic(double kappa, double JMinusOne) {
    const double logJ = std::log1p(JMinusOne);
    return {logJ, kappa * logJ, kappa, 0.5 * kappa * (logJ * logJ)};
  }
};

}  // namespace burnish::inline material
