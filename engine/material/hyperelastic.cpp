#include "engine/material/hyperelastic.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/core/error.h"
#include "engine/material/principal_response.h"
#include "engine/material/volume_change.h"
#include "engine/material/volumetric_response.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

/// Largest ratio of the bulk modulus to the shear modulus: beyond it, Poisson's ratio would have few digits left.
constexpr double kStiffest = 1e9;

/// Poisson's ratio that a bulk modulus stands for.
double poissonsRatioOf(double kappa, double mu) {
  return (3.0 * kappa - 2.0 * mu) / (2.0 * (3.0 * kappa + mu));
}

template <class Energy>
double usableShearModulus(const Energy& energy) {
  const double mu = energy.shearModulus();
  if (!(mu > 0.0) || !std::isfinite(mu))
    throw Error(fmt::format("material: the initial shear modulus is {}, it must be positive", mu));
  return mu;
}

template <class Energy>
double poissonsRatioOf(const HyperelasticParameters<Energy>& parameters) {
  if (parameters.nu.has_value() == parameters.kappa.has_value())
    throw Error("material: a rubber needs either nu or kappa");
  const double mu = usableShearModulus(parameters.energy);
  if (parameters.nu) return *parameters.nu;
  if (!(*parameters.kappa > 0.0))
    throw Error(fmt::format("material: the bulk modulus is {}, it must be positive", *parameters.kappa));
  return poissonsRatioOf(*parameters.kappa, mu);
}

/// Σ_p μ_p (λ̄_A^α_p − λ̄_B^α_p) (λ_A² + λ_B²)/(λ_A² − λ_B²) / 2 from the mean of the logarithms and their
/// difference: free of cancellation, however near the stretches are.
double secantModulus(const IsochoricPoint& point, double mean, double difference) {
  double secant = 0.0;
  for (const auto& [mu, alpha] : point.powers())
    secant += mu * std::exp(alpha * mean) *
              (difference == 0.0 ? 0.5 * alpha : std::sinh(0.5 * alpha * difference) / std::tanh(difference));
  return secant;
}

/// Π B Π with Π = 1 − ⅓ 1 ⊗ 1.
Eigen::Matrix3d deviatoric(const Eigen::Matrix3d& B) {
  const Eigen::Matrix3d rows = B.rowwise() - B.colwise().mean();
  return rows.colwise() - rows.rowwise().mean();
}

}  // namespace

template <class Energy>
Hyperelastic<Energy>::Hyperelastic(const Parameters& parameters)
    : energy_(parameters.energy),
      nu_(poissonsRatioOf(parameters)),
      moduli_(2.0 * usableShearModulus(energy_) * (1.0 + nu_), nu_) {
  if (parameters.kappa) moduli_.kappa = *parameters.kappa;  // not by way of nu, which has lost its digits
}

template <class Energy>
template <int Dim>
bool Hyperelastic<Energy>::evaluate(const Eigen::Matrix3d& F, const State&, State&,
                                    MaterialResponse<Dim>& out) const {
  const Eigen::Matrix3d H = F - Eigen::Matrix3d::Identity();
  const VolumeChange volume(H);
  if (!(volume.J() > 0.0)) return false;
  // The axes of b − 1, whose values λ² − 1 keep their digits at small strains.
  const PrincipalAxes<Dim> axes(H + H.transpose() + H * H.transpose());
  if (!(axes.values.minCoeff() > -1.0)) return false;
  const Eigen::Array3d strain = 0.5 * axes.values.array().log1p();
  const Eigen::Array3d isochoric = strain - strain.mean();

  const VolumetricResponse volumetric = VolumetricResponse::squared(moduli_.kappa, volume.minusOne());
  const IsochoricPoint point = energy_.at(isochoric);
  Eigen::Array3d beta = Eigen::Array3d::Zero();  // but for a constant, which Π takes away
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  for (const auto& [mu, alpha] : point.powers()) {
    const Eigen::Array3d power = mu * (alpha * isochoric).expm1();
    beta += power;
    B.diagonal().array() += alpha * (mu + power);
  }
  if (point.coupling != 0.0) {
    const Eigen::Vector3d squares = (2.0 * isochoric).exp().matrix();
    B += point.coupling * squares * squares.transpose();
  }

  PrincipalResponse<Dim> principal;
  principal.tau = (beta - beta.mean() + volumetric.pressure).matrix();
  principal.D = deviatoric(B);
  principal.D.array() += volumetric.stiffness;
  for (int pair = 0; pair < PrincipalAxes<Dim>::kPairs; ++pair) {
    const int A = PrincipalAxes<Dim>::first(pair);
    const int C = PrincipalAxes<Dim>::second(pair);
    principal.secant[pair] =
        secantModulus(point, 0.5 * (isochoric[A] + isochoric[C]), isochoric[A] - isochoric[C]);
  }
  principal.turn(axes, out);
  out.strainEnergy = point.energy + volumetric.energy;
  out.plasticWork = 0.0;
  return std::isfinite(out.strainEnergy) && std::isfinite(out.tau.sum()) && std::isfinite(out.c.sum());
}

template <class Energy>
void check(const HyperelasticParameters<Energy>& law, const Problems& problems) {
  if constexpr (requires { check(law.energy, problems); }) check(law.energy, problems);
  if (!problems.clean()) return;
  if (law.nu && law.kappa)
    problems.report("kappa", "found beside nu; allowed: one of them, the other one follows from it.");
  const double mu = law.energy.shearModulus();
  if (!(mu > 0.0))
    problems.report(
        fmt::format("found an initial shear modulus of {}; allowed: constants with a positive one.", mu));
  else if (law.kappa && *law.kappa > kStiffest * mu)
    problems.report(
        "kappa", fmt::format("found {}; allowed: at most {:g} times the initial shear modulus, which is {}.",
                             *law.kappa, kStiffest, mu));
}

template class Hyperelastic<MooneyRivlin>;
template bool Hyperelastic<MooneyRivlin>::evaluate<2>(const Eigen::Matrix3d&, const State&, State&,
                                                      MaterialResponse<2>&) const;
template bool Hyperelastic<MooneyRivlin>::evaluate<3>(const Eigen::Matrix3d&, const State&, State&,
                                                      MaterialResponse<3>&) const;
template void check(const HyperelasticParameters<MooneyRivlin>&, const Problems&);

template class Hyperelastic<Yeoh>;
template bool Hyperelastic<Yeoh>::evaluate<2>(const Eigen::Matrix3d&, const State&, State&,
                                              MaterialResponse<2>&) const;
template bool Hyperelastic<Yeoh>::evaluate<3>(const Eigen::Matrix3d&, const State&, State&,
                                              MaterialResponse<3>&) const;
template void check(const HyperelasticParameters<Yeoh>&, const Problems&);

template class Hyperelastic<Ogden>;
template bool Hyperelastic<Ogden>::evaluate<2>(const Eigen::Matrix3d&, const State&, State&,
                                               MaterialResponse<2>&) const;
template bool Hyperelastic<Ogden>::evaluate<3>(const Eigen::Matrix3d&, const State&, State&,
                                               MaterialResponse<3>&) const;
template void check(const HyperelasticParameters<Ogden>&, const Problems&);

}  // namespace burnish::inline material
