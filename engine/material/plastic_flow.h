#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "engine/material/hardening.h"
#include "engine/material/hill_yield.h"
#include "engine/material/mandel.h"
#include "engine/material/rate_law.h"

/// Plastic flow of small strains with isotropic and kinematic hardening and rates. Deviators are referred to axes in
/// which the yield condition is diagonal: T = basis·t, σ_H² = Σ η_j t_j².
namespace burnish::inline material {

/// Number of components of a deviator.
template <int Dim>
inline constexpr int kDeviator = kVoigt<Dim> - 1;

template <int Dim>
using Deviator = Eigen::Array<double, kDeviator<Dim>, 1>;
template <int Dim>
using DeviatorMatrix = Eigen::Matrix<double, kDeviator<Dim>, kDeviator<Dim>>;

/// The axes of a yield condition.
template <int Dim>
struct YieldAxes {
  Eigen::Matrix<double, kVoigt<Dim>, kDeviator<Dim>> basis;  ///< orthonormal deviators, in Mandel's notation
  Deviator<Dim> eta;                                         ///< > 0

  /// von Mises where none is given.
  explicit YieldAxes(const std::optional<HillYield>& hill);

  double norm(const Deviator<Dim>& t) const;
};

/// A back stress after Armstrong and Frederick, Ẋ = ⅔ C Ė^p − γ X ė, or with an exponent the second law of Ohno and
/// Wang, Ẋ = ⅔ C Ė^p − γ (X̄/r)^m ⟨Ė^p : X/X̄⟩ X with r = C/γ, which hardly recovers below r.
struct BackStress {
  double modulus = 0.0;              ///< C
  double recovery = 0.0;             ///< γ
  std::optional<double> exponent{};  ///< m
};

template <class Visitor>
void describe(Visitor& v, BackStress& s) {
  v.field("modulus", s.modulus, {.required = true, .above = 0, .unit = "stress"},
          "Growth of the back stress per unit of plastic strain, at first.");
  v.field("recovery", s.recovery, {.atLeast = 0},
          "How fast it tends to modulus/recovery; 0 is linear kinematic hardening.");
  v.field(
      "exponent", s.exponent, {.atLeast = 0, .atMost = 1000},
      "Recovery after Ohno and Wang, with this power of the back stress over modulus/recovery; the larger it "
      "is, the less a metal ratchets. After Armstrong and Frederick when left out.");
}

inline constexpr int kMostBackStresses = 4;

/// What flow depends on beside the yield condition.
struct FlowLaw {
  double mu = 0.0;
  const Hardening* hardening = nullptr;
  const std::vector<BackStress>* backStresses = nullptr;  ///< at most `kMostBackStresses`
  const std::optional<RateLaw>* rate = nullptr;
};

/// What a point has been through, and what has come of it within a step that is divided into parts.
template <int Dim>
struct FlowState {
  using Vector = Deviator<Dim>;
  using Matrix = DeviatorMatrix<Dim>;

  double e_p = 0.0;
  Eigen::Array<double, kDeviator<Dim>, kMostBackStresses> X =
      Eigen::Array<double, kDeviator<Dim>, kMostBackStresses>::Zero();
  Vector plasticStrain = Vector::Zero();  ///< of the step so far

  // Derivatives with respect to the deviator of the strain at the end of the step.
  Matrix dPlasticStrain = Matrix::Zero();
  std::array<Matrix, kMostBackStresses> dX;
  Eigen::Matrix<double, 1, kDeviator<Dim>> de_p = Eigen::Matrix<double, 1, kDeviator<Dim>>::Zero();

  FlowState() { dX.fill(Matrix::Zero()); }
};

enum class FlowResult { Elastic, Flows, Failed };

/// Goes on to the deviator `strain` of the total strain less what was plastic before the step. part: of the step that is
/// done then, (0, 1], on which the derivative of `strain` with respect to its value at the end depends; dt: the time
/// since the last part, infinite if rates play no role.
///
/// Back stresses follow the exact solution in a constant direction, X = θ X_n + ⅔ C (ψ/Δe) ΔE^p with θ = exp(−γ Δe) and
/// ψ = (1 − θ)/γ, so that one scalar equation is left, σ_H(ξ) = σ_y(e_p) with its dependence on the rate, for
/// ξ = dev T − ΣX. Those after Ohno and Wang follow the backward Euler rule, which leaves an equation for the tensor ΔE^p.
/// Failed: there is no positive yield stress, or numbers overflow.
template <int Dim>
FlowResult flow(const FlowLaw& law, const YieldAxes<Dim>& axes, const Deviator<Dim>& strain, double part,
                double dt, FlowState<Dim>& state);

}  // namespace burnish::inline material
