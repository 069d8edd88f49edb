#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/core/lanes.h"
#include "engine/material/hardening.h"

namespace burnish {

inline constexpr double kRootTwoThirds = 0.81649658092772603;  // √(2/3)

/// Stored energy of the elastic part, in principal elastic stretches.
/// NeoHookean: W = κ/2 (½(J²−1) − ln J) + μ/2 (Σ λ̄_A² − 3); Hencky: W = κ/2 (ln J)² + μ Σ (dev ε_A)².
enum class ElasticLaw { NeoHookean, Hencky };

/// Isochoric part of an elastic law in principal directions.
struct DeviatoricLaw {
  ElasticLaw law;
  double mu;
};

/// State in principal directions at the end of a step, and its linearisation.
struct PrincipalState {
  Eigen::Array3d e;        ///< deviator of the elastic logarithmic strains
  Eigen::Array3d s;        ///< deviatoric Kirchhoff stress
  Eigen::Matrix3d D;       ///< ds/dε^tr, symmetric, annihilates (1,1,1)
  Eigen::Array3d modulus;  ///< (s_A − s_B)/(ε^tr_A − ε^tr_B) → ½(modulus_A + modulus_B) for equal strains
  double energy;           ///< isochoric part of the stored energy
  double e_p;
};

/// Where a plastic step begins.
struct TrialState {
  Eigen::Array3d e;  ///< deviator of the trial strains, beyond the yield surface
  double e_p;
};

/// The state of an elastic step with the Hencky energy.
PrincipalState elasticHenckyState(double mu, const TrialState& trial);

/// The states of plastic steps at up to `kLanes` points, each from its trial state:
///   e + Δγ s/‖s‖ = e_tr,   ‖s(e)‖ = √(2/3) σ_y(e_p,n + √(2/3) Δγ),
/// solved to round-off. Nothing for a point where there is no such state: no positive yield stress, numbers
/// that overflow.
void returnMap(const DeviatoricLaw& law, const Hardening& hardening, std::span<const TrialState> trials,
               std::span<std::optional<PrincipalState>> states);

}  // namespace burnish
