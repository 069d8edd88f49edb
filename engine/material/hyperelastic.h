#pragma once
#include <optional>
#include <utility>

#include "engine/material/elastic_moduli.h"
#include "engine/material/law_list.h"
#include "engine/material/mooney_rivlin.h"
#include "engine/material/ogden.h"
#include "engine/material/push_forward.h"
#include "engine/material/response.h"
#include "engine/material/yeoh.h"

namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// What a nearly incompressible rubber is made from.
template <class Energy>
struct HyperelasticParameters {
  Energy energy;                  ///< isochoric
  std::optional<double> nu{};     ///< Poisson's ratio of small strains, (-1, 0.5)
  std::optional<double> kappa{};  ///< bulk modulus, > 0; this one or `nu`
};

/// Isotropic elasticity in principal stretches, split into the change of shape and that of volume:
///   W = W̄(λ̄) + κ/2 (½(J² − 1) − ln J),   λ̄_A = J^{-1/3} λ_A.
/// An `Energy` W̄ has `kind`, `describe`, `shearModulus()` of small strains, `at(logStretches)`, and `check` if
/// the rules of its keys do not say all.
template <class Energy>
class Hyperelastic {
 public:
  static constexpr LawKind kind = Energy::kind;

  using Parameters = HyperelasticParameters<Energy>;

  /// Nothing: the stress depends on the present deformation alone.
  struct State {};

  /// Throws `Error` unless the shear modulus of small strains is positive, and one of `nu` and `kappa` is given
  /// and can be.
  explicit Hyperelastic(const Parameters& parameters);

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }
  double poissonsRatio() const { return nu_; }
  double bulkModulus() const { return moduli_.kappa; }

  /// Response at the deformation gradient F (Dim 2: a 2x2 block and F_33). False when J <= 0 or a result is
  /// not finite: then `out` is not to be used.
  template <int Dim>
  [[nodiscard]] bool evaluate(const Eigen::Matrix3d& F, const State& old, State& next,
                              MaterialResponse<Dim>& out) const;

  /// b = F F^T.
  Eigen::Matrix3d elasticDeformation(const Eigen::Matrix3d& F, const State&) const {
    return pushedForward(Eigen::Matrix3d::Identity(), F);
  }

 private:
  Energy energy_;
  double nu_;
  ElasticModuli moduli_;
};

template <class Visitor, class Energy>
void describe(Visitor& v, HyperelasticParameters<Energy>& s) {
  describe(v, s.energy);
  v.field("nu", s.nu, {.required = true, .unless = "kappa", .above = -1, .below = 0.5},
          "Poisson's ratio of small strains; give either this or kappa.");
  v.field(
      "kappa", s.kappa, {.above = 0, .unit = "stress"},
      "Bulk modulus; the energy of volume is kappa/2 ((J^2 - 1)/2 - ln J). A thousand times the shear modulus is usual.");
}

/// See `checkMaterial`.
template <class Energy>
void check(const HyperelasticParameters<Energy>& law, const Problems& problems);

extern template class Hyperelastic<MooneyRivlin>;
extern template class Hyperelastic<Yeoh>;
extern template class Hyperelastic<Ogden>;

}  // namespace burnish::inline material
