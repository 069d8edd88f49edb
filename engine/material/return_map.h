#pragma once
#include <Eigen/Core>
#include <optional>

#include "engine/material/hardening.h"

namespace burnish::inline material {

inline constexpr double kRootTwoThirds = 0.81649658092772603;  // √(2/3)

/// Stored energy of the elastic part, in principal elastic stretches.
/// NeoHookean: W = κ/2 (½(J²−1) − ln J) + μ/2 (Σ λ̄_A² − 3); Hencky: W = κ/2 (ln J)² + μ Σ (dev ε_A)².
enum class ElasticLaw { NeoHookean, Hencky };

/// Isochoric part of an elastic law in principal directions, as a function of the deviator e = dev ln λ.
struct DeviatoricLaw {
  ElasticLaw law;
  double mu;

  struct Answer {
    Eigen::Array3d s;        ///< deviatoric Kirchhoff stress
    Eigen::Array3d modulus;  ///< m with ds/de = P diag(m) P, P the projection on deviators
    double energy;
  };
  Answer operator()(const Eigen::Array3d& e) const;
};

/// Yield stress and its derivative.
struct HardeningPoint {
  double sigma_y;
  double slope;
};
HardeningPoint hardeningAt(const Hardening& hardening, double e_p);

/// State in principal directions at the end of a step, and its linearisation.
struct PrincipalState {
  Eigen::Array3d e;        ///< deviator of the elastic logarithmic strains
  Eigen::Array3d s;        ///< deviatoric Kirchhoff stress
  Eigen::Matrix3d D;       ///< ds/dε^tr, symmetric, annihilates (1,1,1)
  Eigen::Array3d modulus;  ///< (s_A − s_B)/(ε^tr_A − ε^tr_B) → ½(modulus_A + modulus_B) for equal strains
  double energy;           ///< isochoric part of the stored energy
  double e_p;
};

/// The state of an elastic step: e = e_tr.
PrincipalState elasticState(const DeviatoricLaw& law, const Eigen::Array3d& e_tr, double e_p);

/// The state of a plastic step from the deviator e_tr of the trial strains (beyond the yield surface):
///   e + Δγ s/‖s‖ = e_tr,   ‖s(e)‖ = √(2/3) σ_y(e_p,n + √(2/3) Δγ),
/// solved to round-off. Nothing when there is no such state: no positive yield stress, numbers that overflow.
std::optional<PrincipalState> returnMap(const DeviatoricLaw& law, const Hardening& hardening,
                                        const Eigen::Array3d& e_tr, double e_p_old);

}  // namespace burnish::inline material
