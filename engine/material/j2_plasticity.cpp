#include "engine/material/j2_plasticity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/material/principal_response.h"
#include "engine/material/push_forward.h"
#include "engine/material/symmetric_tensor.h"
#include "engine/material/volume_change.h"
#include "engine/material/volumetric_response.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

/// Relative distance to the yield surface within which a trial state is elastic: states that a converged step
/// has put on the surface stay elastic when they are evaluated again.
constexpr double kYieldTolerance = 1e-11;

/// Relative distance of squared stretches below which the shear moduli take their limit.
constexpr double kEqualStretches = 1e-6;

VolumetricResponse volumetricResponse(ElasticLaw law, double kappa, double JMinusOne) {
  return law == ElasticLaw::Hencky ? VolumetricResponse::logarithmic(kappa, JMinusOne)
                                   : VolumetricResponse::squared(kappa, JMinusOne);
}

/// The neo-Hookean law in closed form, at the isochoric left Cauchy-Green tensor b̄. False, and nothing is
/// set, when ‖dev τ‖ exceeds the radius of the yield surface.
template <int Dim>
bool setNeoHookeanWithin(double radius, double mu, const VolumetricResponse& volumetric,
                         const SymmetricTensor<Dim>& bBar, MaterialResponse<Dim>& out) {
  const SymmetricTensor<Dim> one = identityComponents<Dim>();
  const double trace = bBar.template head<3>().sum();
  const double meanModulus = mu * trace / 3.0;
  const SymmetricTensor<Dim> s = mu * bBar - meanModulus * one;
  if (squaredNorm<Dim>(s) > radius * radius) return false;
  out.tau = s + volumetric.pressure * one;
  out.c = isotropicTangent<Dim>(volumetric.stiffness - 2.0 / 3.0 * meanModulus,
                                2.0 * (meanModulus - volumetric.pressure));
  out.c -= 2.0 / 3.0 * (s * one.transpose() + one * s.transpose());
  out.strainEnergy = volumetric.energy + 0.5 * mu * (trace - 3.0);
  return true;
}

/// ½(τ_A − τ_B)(a + b)/(a − b) of two directions with the squared trial stretches a and b. The secant of the
/// limit differs from the tangent ¼(D_AA + D_BB − D_AB − D_BA) of the same branch by terms of second order in
/// a − b.
double secantModulus(double a, double b, double tauA, double tauB, double equalModulus) {
  const double difference = a - b;
  return std::abs(difference) < kEqualStretches * std::max(a, b) ? 0.5 * equalModulus
                                                                 : 0.5 * (tauA - tauB) * (a + b) / difference;
}

/// Stress, tangent and energy from principal values.
template <int Dim>
void setPrincipal(const PrincipalAxes<Dim>& axes, const VolumetricResponse& volumetric,
                  const PrincipalState& state, MaterialResponse<Dim>& out) {
  PrincipalResponse<Dim> principal;
  const Eigen::Vector3d& tau = principal.tau = (state.s + volumetric.pressure).matrix();
  principal.D = state.D;
  principal.D.array() += volumetric.stiffness;
  for (int pair = 0; pair < PrincipalAxes<Dim>::kPairs; ++pair) {
    const int A = axes.first(pair);
    const int B = axes.second(pair);
    principal.secant[pair] = secantModulus(axes.values[A], axes.values[B], tau[A], tau[B],
                                           0.5 * (state.modulus[A] + state.modulus[B]));
  }
  principal.turn(axes, out);
  out.strainEnergy = volumetric.energy + state.energy;
}

double hardeningWork(const Hardening& hardening, double from, double to) {
  return std::visit([=](const auto& law) { return law.work(to) - law.work(from); }, hardening);
}

template <int Dim>
bool isFinite(const MaterialResponse<Dim>& out) {
  return std::isfinite(out.tau.sum() + out.strainEnergy);
}

}  // namespace

J2Plasticity::J2Plasticity(const Parameters& parameters)
    : moduli_(parameters.E, parameters.nu),
      nu_(parameters.nu),
      elasticLaw_(parameters.elastic),
      hardening_(HardeningLaws::make(parameters.hardening)) {}

double J2Plasticity::yieldStress(double e_p) const {
  return std::visit([e_p](const auto& law) { return law.sigma_y(e_p); }, hardening_);
}

Eigen::Matrix3d J2Plasticity::elasticDeformation(const Eigen::Matrix3d& F, const State& state) const {
  return pushedForward(state.b_e, F * state.F_inv);
}

void check(const J2Plasticity::Parameters& law, const Problems& problems) {
  checkHardening(law.hardening, problems, "hardening");
}

template <int Dim>
bool J2Plasticity::evaluate(const Eigen::Matrix3d& F, const State& old, State& next,
                            MaterialResponse<Dim>& out) const {
  const VolumeChange volume(F - Eigen::Matrix3d::Identity());
  if (!(volume.J() > 0.0)) return false;
  const VolumetricResponse volumetric = volumetricResponse(elasticLaw_, moduli_.kappa, volume.minusOne());
  const double radius = kRootTwoThirds * yieldStress(old.e_p) * (1.0 + kYieldTolerance);
  next = old;
  out.plasticWork = 0.0;

  // Elastic predictor
  const Eigen::Matrix3d f = F * old.F_inv;
  const Eigen::Matrix3d b = f * old.b_e * f.transpose();
  if (elasticLaw_ == ElasticLaw::NeoHookean) {
    const SymmetricTensor<Dim> bBar = components<Dim>(b) * std::exp(-2.0 / 3.0 * volumetric.logJ);
    if (setNeoHookeanWithin<Dim>(radius, moduli_.mu, volumetric, bBar, out)) return isFinite(out);
  }
  const PrincipalAxes<Dim> axes(b);
  if (!(axes.values.minCoeff() > 0.0)) return false;
  const Eigen::Array3d strain = 0.5 * axes.values.array().log();
  const double mean = strain.sum() / 3.0;
  const Eigen::Array3d e_tr = strain - mean;
  const DeviatoricLaw law{elasticLaw_, moduli_.mu};
  if (elasticLaw_ == ElasticLaw::Hencky && 2.0 * moduli_.mu * e_tr.matrix().norm() <= radius) {
    setPrincipal(axes, volumetric, elasticState(law, e_tr, old.e_p), out);
    return isFinite(out);
  }

  // Return to the yield surface
  const std::optional<PrincipalState> state = returnMap(law, hardening_, e_tr, old.e_p);
  if (!state) return false;
  setPrincipal(axes, volumetric, *state, out);
  const Eigen::Vector3d elasticStretches = (2.0 * (state->e + mean)).exp().matrix();
  next.F_inv = F.inverse();
  next.b_e = fullTensor<Dim>(axes.tensor(elasticStretches));
  next.e_p = state->e_p;
  out.plasticWork = hardeningWork(hardening_, old.e_p, next.e_p);
  return isFinite(out);
}

template bool J2Plasticity::evaluate<2>(const Eigen::Matrix3d&, const State&, State&,
                                        MaterialResponse<2>&) const;
template bool J2Plasticity::evaluate<3>(const Eigen::Matrix3d&, const State&, State&,
                                        MaterialResponse<3>&) const;

}  // namespace burnish::inline material
