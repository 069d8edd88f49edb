#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/enum_names.h"
#include "engine/material/elastic_moduli.h"
#include "engine/material/hardening.h"
#include "engine/material/hill_yield.h"
#include "engine/material/plastic_flow.h"
#include "engine/material/rate_law.h"
#include "engine/material/response.h"
#include "engine/material/state_field.h"

namespace burnish::inline material {

/// What the logarithm of the elastic strain is taken of.
enum class StrainFrame {
  Updated,   ///< F_e = F F_p⁻¹
  Additive,  ///< F, and the plastic strain is taken off: ½ ln FᵀF − E_p
};

constexpr auto enumNames(std::type_identity<StrainFrame>) {
  return std::array{std::pair{"updated", StrainFrame::Updated}, std::pair{"additive", StrainFrame::Additive}};
}

/// Plasticity at finite strain with isotropic hardening and back stresses (J. L. Chaboche, Int. J. Plast. 2, 1986), with
/// rates and Hill's yield condition: the small-strain law of `plastic_flow.h` in logarithmic elastic strains, with a
/// multiplicative split F = F_e F_p whose F_p has no spin of its own. Strength does not suffer from large shears, as it
/// does where a plastic strain is taken off the logarithm of F (`StrainFrame::Additive`; C. Miehe, N. Apel, M. Lambrecht,
/// 2002). Without back stresses this is `J2Plasticity` of Hencky's elastic law.
class Chaboche {
 public:
  static constexpr LawKind kind{
      "chaboche",
      "Finite-strain plasticity of metals that are loaded to and fro: isotropic hardening, "
      "back stresses, rates, and the anisotropy of sheets."};

  struct Parameters {
    double E = 0.0;   ///< Young's modulus, > 0
    double nu = 0.0;  ///< Poisson's ratio, (-1, 0.5)
    HardeningParameters hardening{};
    std::vector<BackStress> backStresses;  ///< at most `kMostBackStresses`
    std::optional<RateParameters> rate;
    std::optional<HillYield> hill;
    int substeps = 1;
    StrainFrame frame = StrainFrame::Updated;
  };

  /// In axes that turn with the material: those in which F_e = F F_p^{-1} is referred to before it is made.
  struct State {
    Eigen::Matrix3d Fp_inv = Eigen::Matrix3d::Identity();  ///< F_p^{-1}; in the additive frame exp(−E_p)
    Eigen::Matrix<double, 6, 1> E =
        Eigen::Matrix<double, 6, 1>::Zero();  ///< elastic strain ½ ln F_eᵀF_e (Mandel)
    double e_p = 0.0;                         ///< equivalent plastic strain
    Eigen::Matrix<double, 6, kMostBackStresses> X =
        Eigen::Matrix<double, 6, kMostBackStresses>::Zero();  ///< back stresses (Mandel)

    template <class F>
    void forEachMember(const F& f) {
      f(Fp_inv);
      f(E);
      f(e_p);
      f(X);
    }
  };

  static std::vector<StateField<State>> fields();
  static std::vector<CarriedNumber<State>> carried();

  /// A state with the elastic stretch V_e that has not flowed.
  static State begin(const Eigen::Matrix3d& stretch);

  /// The state with what is carried referred to the axes of space at the deformation gradient F, and back: what
  /// lies between points of different histories can be interpolated there alone. `Fp_inv` is the rotation of the
  /// axes then, what is nearest to one where it was interpolated; none where the axes play no role.
  State toSpace(const Eigen::Matrix3d& F, const State& state) const;
  State fromSpace(const State& state) const;

  /// Throws `Error` unless E > 0 and -1 < nu < 0.5, and what the hardening law throws.
  explicit Chaboche(const Parameters& parameters);

  double youngsModulus() const { return moduli_.E; }
  double shearModulus() const { return moduli_.mu; }
  double poissonsRatio() const { return parameters_.nu; }
  double yieldStress(double e_p) const;

  /// Recovery and parts of a step make a tangent that is not symmetric where the direction of flow turns.
  bool hasSymmetricTangent() const;

  /// Response at the deformation gradient F (Dim 2: a 2x2 block and F_33) at the end of a step of the length dt, and the
  /// history that follows from `old` when the step is accepted. Plastic work is ½ (T_n + T_{n+1}) : ΔE^p, of which
  /// back stresses store Σ ¾ X:X/C. False when F is none, a result is not finite or there is no positive yield
  /// stress: then `next` and `out` are not to be used.
  template <int Dim>
  [[nodiscard]] bool evaluate(const Eigen::Matrix3d& F, double dt, const State& old, State& next,
                              MaterialResponse<Dim>& out) const;

  /// b_e at the deformation gradient F, without flow since `state`.
  Eigen::Matrix3d elasticDeformation(const Eigen::Matrix3d& F, const State& state) const;

 private:
  template <int Dim>
  const YieldAxes<Dim>& yieldAxes() const;

  Parameters parameters_;
  ElasticModuli moduli_;
  Hardening hardening_;
  std::optional<RateLaw> rate_;
  YieldAxes<2> planeAxes_;
  YieldAxes<3> axes_;
};

template <class Visitor>
void describe(Visitor& v, Chaboche::Parameters& s) {
  describeElasticConstants(v, s.E, s.nu);
  v.field("hardening", s.hardening, {.required = true}, "Yield stress; isotropic hardening.");
  v.field("back_stresses", s.backStresses, {.maxEntries = kMostBackStresses},
          "Kinematic hardening: back stresses, which add up.");
  v.field("rate", s.rate, {}, "Dependence on the rate; the time of the scene is that of its constants then.");
  v.field("hill", s.hill, {},
          "Anisotropy of a sheet after Hill (1948), with axes that turn with the material.");
  v.field(
      "substeps", s.substeps, {.atLeast = 1, .atMost = 100},
      "Parts into which the law divides a step; 8 of them are more accurate where the direction of flow turns.");
  v.field(
      "frame", s.frame, {},
      "What elastic strain is the logarithm of: of the elastic part of the deformation, or of all of it less a "
      "plastic strain, as in some other programs, which loses a third of the strength at a shear of 3.");
}

/// See `checkMaterial`.
void check(const Chaboche::Parameters& law, const Problems& problems);
void checkInPlane(const Chaboche::Parameters& law, const Problems& problems);

}  // namespace burnish::inline material
