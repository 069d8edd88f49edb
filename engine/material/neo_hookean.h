#pragma once
#include <array>
#include <utility>

#include "engine/core/enum_names.h"
#include "engine/material/elastic_moduli.h"
#include "engine/material/law_list.h"
#include "engine/material/push_forward.h"
#include "engine/material/response.h"

namespace burnish::inline material {

/// Compressible neo-Hookean solid: W(F) = μ/2 (tr C − 3) − μ ln J + U(J).
class NeoHookean {
 public:
  static constexpr LawKind kind{"neo-hookean", "Compressible neo-Hookean elasticity."};

  /// Log: U = λ/2 (ln J)²; Simo: U = λ/4 (J² − 1 − 2 ln J).
  enum class Volumetric { Log, Simo };

  struct Parameters {
    double E = 0.0;   ///< Young's modulus, > 0
    double nu = 0.0;  ///< Poisson's ratio, (-1, 0.5)
    Volumetric volumetric = Volumetric::Log;
  };

  /// Nothing: the stress depends on the present deformation alone.
  struct State {};

  /// Throws `Error` unless E > 0 and -1 < nu < 0.5.
  explicit NeoHookean(const Parameters& parameters)
      : parameters_(parameters), moduli_(parameters.E, parameters.nu) {}

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }
  double poissonsRatio() const { return parameters_.nu; }

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
  Parameters parameters_;
  ElasticModuli moduli_;
};

constexpr auto enumNames(std::type_identity<NeoHookean::Volumetric>) {
  return std::array{std::pair{"log", NeoHookean::Volumetric::Log},
                    std::pair{"simo", NeoHookean::Volumetric::Simo}};
}

template <class Visitor>
void describe(Visitor& v, NeoHookean::Parameters& s) {
  describeElasticConstants(v, s.E, s.nu);
  v.field("volumetric", s.volumetric, {},
          "Volumetric energy U: log is lambda/2 (ln J)^2, simo is lambda/4 (J^2 - 1 - 2 ln J).");
}

}  // namespace burnish::inline material
