#pragma once
#include <array>
#include <utility>
#include <vector>

#include "engine/core/enum_names.h"
#include "engine/material/elastic_moduli.h"
#include "engine/material/hardening.h"
#include "engine/material/plastic_strain_field.h"
#include "engine/material/response.h"
#include "engine/material/return_map.h"
#include "engine/material/state_field.h"

namespace burnish::inline material {

/// J2 plasticity at finite strain: multiplicative split, yield condition in Kirchhoff stress, isotropic
/// hardening, exponential map in principal logarithmic strains with the consistent tangent.
class J2Plasticity {
 public:
  static constexpr LawKind kind{
      "j2", "Finite-strain plasticity with the von Mises yield condition and isotropic hardening."};

  struct Parameters {
    double E = 0.0;   ///< Young's modulus, > 0
    double nu = 0.0;  ///< Poisson's ratio, (-1, 0.5)
    ElasticLaw elastic = ElasticLaw::NeoHookean;
    HardeningParameters hardening{};
  };

  /// Where plastic flow last left a point. The pair (F_inv, b_e) stands for Cp^{-1} = F^{-1} b_e F^{-T}: a
  /// trial state needs only the deformation f = F F_inv since then, b_tr = f b_e f^T, whose rounding error
  /// grows with the condition of F and not with its square.
  struct State {
    Eigen::Matrix3d F_inv =
        Eigen::Matrix3d::Identity();  ///< inverse deformation gradient at the last plastic flow
    Eigen::Matrix3d b_e = Eigen::Matrix3d::Identity();  ///< elastic left Cauchy-Green tensor there
    double e_p = 0.0;                                   ///< equivalent plastic strain

    /// Inverse plastic right Cauchy-Green tensor.
    Eigen::Matrix3d Cp_inv() const { return F_inv * b_e * F_inv.transpose(); }

    template <class F>
    void forEachMember(const F& f) {
      f(F_inv);
      f(b_e);
      f(e_p);
    }
  };

  static std::vector<StateField<State>> fields() { return {plasticStrainField<State>()}; }

  static std::vector<CarriedNumber<State>> carried() {
    return {{{.name = "e_p", .atLeast = 0.0}, [](State& state) -> double& { return state.e_p; }}};
  }

  /// Throws `Error` unless E > 0 and -1 < nu < 0.5, and what the hardening law throws.
  explicit J2Plasticity(const Parameters& parameters);

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }
  double poissonsRatio() const { return nu_; }
  double yieldStress(double e_p) const;

  /// Response at the deformation gradient F (Dim 2: a 2x2 block and F_33) and the history that follows from
  /// `old` when the step is accepted. False when J <= 0, a result is not finite or the return map failed:
  /// then `next` and `out` are not to be used.
  template <int Dim>
  [[nodiscard]] bool evaluate(const Eigen::Matrix3d& F, const State& old, State& next,
                              MaterialResponse<Dim>& out) const;

  /// b_e at the deformation gradient F, without flow since `state`.
  Eigen::Matrix3d elasticDeformation(const Eigen::Matrix3d& F, const State& state) const;

 private:
  ElasticModuli moduli_;
  double nu_;
  ElasticLaw elasticLaw_;
  Hardening hardening_;
};

constexpr auto enumNames(std::type_identity<ElasticLaw>) {
  return std::array{std::pair{"neo-hookean", ElasticLaw::NeoHookean},
                    std::pair{"hencky", ElasticLaw::Hencky}};
}

template <class Visitor>
void describe(Visitor& v, J2Plasticity::Parameters& s) {
  describeElasticConstants(v, s.E, s.nu);
  v.field("elastic", s.elastic, {}, "Elastic law in principal stretches.");
  v.field("hardening", s.hardening, {.required = true}, "Yield stress.");
}

/// See `checkMaterial`.
void check(const J2Plasticity::Parameters& law, const Problems& problems);

}  // namespace burnish::inline material
