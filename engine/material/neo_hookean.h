#pragma once
#include "engine/material/elastic_moduli.h"
#include "engine/material/response.h"

namespace burnish {

/// Compressible neo-Hookean solid: W(F) = μ/2 (tr C − 3) − μ ln J + U(J).
class NeoHookean {
 public:
  /// Log: U = λ/2 (ln J)²; Simo: U = λ/4 (J² − 1 − 2 ln J).
  enum class Volumetric { Log, Simo };

  /// Throws `Error` unless E > 0 and -1 < nu < 0.5.
  NeoHookean(double E, double nu, Volumetric volumetric = Volumetric::Log)
      : moduli_(E, nu), volumetric_(volumetric) {}

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }

  /// Response at the deformation gradient F (Dim 2: a 2x2 block and F_33); the history passes unchanged from
  /// `old` to `next`. False when J <= 0 or a result is not finite: then `next` and `out` are not to be used.
  template <int Dim>
  [[nodiscard]] bool evaluate(const Eigen::Matrix3d& F, const MaterialState& old, MaterialState& next,
                              MaterialResponse<Dim>& out) const;

 private:
  ElasticModuli moduli_;
  Volumetric volumetric_;
};

}  // namespace burnish
