#pragma once
#include "engine/material/elastic_moduli.h"
#include "engine/material/hardening.h"
#include "engine/material/response.h"
#include "engine/material/return_map.h"

namespace burnish {

/// J2 plasticity at finite strain: multiplicative split, yield condition in Kirchhoff stress, isotropic
/// hardening, exponential map in principal logarithmic strains with the consistent tangent.
class J2Plasticity {
 public:
  /// Throws `Error` unless E > 0 and -1 < nu < 0.5.
  J2Plasticity(double E, double nu, ElasticLaw elasticLaw, Hardening hardening);

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }
  const Hardening& hardening() const { return hardening_; }

  /// Response at the deformation gradient F (Dim 2: a 2x2 block and F_33) and the history that follows from
  /// `old` when the step is accepted. False when J <= 0, a result is not finite or the return map failed:
  /// then `next` and `out` are not to be used.
  template <int Dim>
  [[nodiscard]] bool evaluate(const Eigen::Matrix3d& F, const MaterialState& old, MaterialState& next,
                              MaterialResponse<Dim>& out) const;

 private:
  ElasticModuli moduli_;
  ElasticLaw elasticLaw_;
  Hardening hardening_;
};

}  // namespace burnish
