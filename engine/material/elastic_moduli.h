#pragma once

namespace burnish {

/// Isotropic moduli from Young's modulus and Poisson's ratio.
struct ElasticModuli {
  double E;       ///< Young's modulus
  double lambda;  ///< Lamé's first parameter Eν/((1+ν)(1−2ν))
  double mu;      ///< shear modulus E/(2(1+ν))
  double kappa;   ///< bulk modulus E/(3(1−2ν))

  /// Throws `Error` unless youngsModulus > 0 and -1 < poissonsRatio < 0.5.
  ElasticModuli(double youngsModulus, double poissonsRatio);
};

}  // namespace burnish
