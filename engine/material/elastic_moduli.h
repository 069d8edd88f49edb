#pragma once

namespace burnish::inline material {

/// Isotropic moduli from Young's modulus and Poisson's ratio.
struct ElasticModuli {
  double E;       ///< Young's modulus
  double lambda;  ///< Lamé's first parameter Eν/((1+ν)(1−2ν))
  double mu;      ///< shear modulus E/(2(1+ν))
  double kappa;   ///< bulk modulus E/(3(1−2ν))

  /// Throws `Error` unless youngsModulus > 0 and -1 < poissonsRatio < 0.5.
  ElasticModuli(double youngsModulus, double poissonsRatio);
};

/// Young's modulus and Poisson's ratio, the same for every law.
template <class Visitor>
void describeElasticConstants(Visitor& v, double& E, double& nu) {
  v.field("E", E, {.required = true, .above = 0, .unit = "stress"}, "Young's modulus.");
  v.field("nu", nu, {.required = true, .above = -1, .below = 0.5}, "Poisson's ratio.");
}

}  // namespace burnish::inline material
