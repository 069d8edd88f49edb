#include "engine/material/chaboche.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/material/logarithmic_strain.h"
#include "engine/material/plastic_strain_field.h"
#include "engine/material/push_forward.h"
#include "engine/material/return_map.h"
#include "engine/material/volume_change.h"
#include "engine/schema/problems.h"

namespace burnish::inline material {
namespace {

using State = Chaboche::State;

/// The von Mises norm √(3/2) ‖X‖.
double equivalent(const Eigen::Matrix<double, 6, 1>& X) {
  return std::sqrt(1.5) * X.norm();
}

/// What is carried of the axes' rotation: each entry.
template <int... Numbers>
std::vector<CarriedNumber<State>> axesNumbers(std::integer_sequence<int, Numbers...>) {
  return {{{.name = std::string("axes_") + "xyz"[Numbers % 3] + "xyz"[Numbers / 3]},
           [](State& state) -> double& { return state.Fp_inv(Numbers % 3, Numbers / 3); }}...};
}

/// Names and places of what is carried: of every back stress each component.
template <int... Numbers>
std::vector<CarriedNumber<State>> backStressNumbers(std::integer_sequence<int, Numbers...>) {
  static constexpr std::array kComponents{"xx", "yy", "zz", "xy", "yz", "zx"};
  return {{{.name = "X" + std::to_string(Numbers / 6 + 1) + "_" + kComponents[Numbers % 6]},
           [](State& state) -> double& { return state.X(Numbers % 6, Numbers / 6); }}...};
}

/// E_p of the additive frame.
template <int Dim>
MandelVector<Dim> plasticStrainOf(const State& state) {
  return -halfLogarithm<Dim>(state.Fp_inv * state.Fp_inv);
}

/// The rotation of the polar decomposition. Entries of rotations can be interpolated, whatever turns they stand for.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

std::vector<StateField<State>> Chaboche::fields() {
  return {plasticStrainField<State>(),
          {{.name = "back_stress",
            .components = {},
            .unit = "stress",
            .words = "Equivalent back stress",
            .symbol = "X_eq",
            .isNonNegative = true},
           [](const State& state, std::span<double> values) {
             values[0] = equivalent(state.X.rowwise().sum());
           }}};
}

std::vector<CarriedNumber<State>> Chaboche::carried() {
  std::vector<CarriedNumber<State>> numbers{
      {{.name = "e_p", .atLeast = 0.0}, [](State& state) -> double& { return state.e_p; }}};
  for (const auto& more : {axesNumbers(std::make_integer_sequence<int, 9>()),
                           backStressNumbers(std::make_integer_sequence<int, 6 * kMostBackStresses>())})
    numbers.insert(numbers.end(), more.begin(), more.end());
  return numbers;
}

State Chaboche::begin(const Eigen::Matrix3d& stretch) {
  State state;
  state.E = halfLogarithm<3>(stretch * stretch);
  return state;
}

State Chaboche::toSpace(const Eigen::Matrix3d& F, const State& state) const {
  State moved = state;
  const Eigen::Matrix3d R = LogarithmicStrain<3>(F * state.Fp_inv).rotation();
  moved.X = mandelRotation<3>(R) * state.X;
  moved.Fp_inv = parameters_.hill ? R : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  return moved;
}

State Chaboche::fromSpace(const State& moved) const {
  State state = moved;
  const Eigen::Matrix3d R = nearestRotation(moved.Fp_inv);
  state.Fp_inv = R;
  const MandelMatrix<3> toLaw = mandelRotation<3>(R).transpose();
  state.E = toLaw * moved.E;
  state.X = toLaw * moved.X;
  const double reach = std::sqrt(axes_.eta.maxCoeff() / 1.5);  // of the direction of flow that goes farthest
  for (Eigen::Index i = 0; i < std::ssize(parameters_.backStresses); ++i) {
    const auto& [C, gamma, exponent] = parameters_.backStresses[static_cast<std::size_t>(i)];
    auto X = state.X.col(i);
    X.head<3>().array() -= X.head<3>().mean();
    // Beyond its bound the scalar equation of the flow might have no solution.
    const double size = equivalent(X);
    if (gamma * size > reach * C) X *= reach * C / (gamma * size);
  }
  return state;
}

Chaboche::Chaboche(const Parameters& parameters)
    : parameters_(parameters),
      moduli_(parameters.E, parameters.nu),
      hardening_(HardeningLaws::make(parameters.hardening)),
      rate_(parameters.rate ? std::optional(RateLaws::make(*parameters.rate)) : std::nullopt),
      planeAxes_(parameters.hill),
      axes_(parameters.hill) {}

double Chaboche::yieldStress(double e_p) const {
  return std::visit([e_p](const auto& law) { return law.sigma_y(e_p); }, hardening_);
}

bool Chaboche::hasSymmetricTangent() const {
  return parameters_.substeps == 1 &&
         std::all_of(parameters_.backStresses.begin(), parameters_.backStresses.end(),
                     [](const BackStress& back) { return back.recovery == 0.0; });
}

template <>
const YieldAxes<2>& Chaboche::yieldAxes<2>() const {
  return planeAxes_;
}

template <>
const YieldAxes<3>& Chaboche::yieldAxes<3>() const {
  return axes_;
}

template <int Dim>
bool Chaboche::evaluate(const Eigen::Matrix3d& F, double dt, const State& old, State& next,
                        MaterialResponse<Dim>& out) const {
  constexpr int kSize = kVoigt<Dim>;
  const VolumeChange volumeChange(F - Eigen::Matrix3d::Identity());
  if (!(volumeChange.J() > 0.0)) return false;
  const bool isAdditive = parameters_.frame == StrainFrame::Additive;
  const LogarithmicStrain<Dim> strain(isAdditive ? F : Eigen::Matrix3d(F * old.Fp_inv));
  if (!strain.isDefined()) return false;
  const YieldAxes<Dim>& axes = yieldAxes<Dim>();
  const auto& basis = axes.basis;
  // Flow keeps the volume; that of F has no rounding errors of the steps before.
  const double volume = std::log1p(volumeChange.minusOne());
  MandelVector<Dim> E_tr = strain.value();
  if (isAdditive) E_tr -= plasticStrainOf<Dim>(old);
  E_tr.template head<3>().array() += (volume - E_tr.template head<3>().sum()) / 3.0;
  const MandelVector<Dim> E_n = old.E.template head<kSize>();
  const Deviator<Dim> e_n = basis.transpose() * E_n, e_tr = basis.transpose() * E_tr;

  const FlowLaw law{moduli_.mu, &hardening_, &parameters_.backStresses, &rate_};
  const int parts = parameters_.substeps;
  FlowState<Dim> flowing;
  flowing.e_p = old.e_p;
  flowing.X = (basis.transpose() * old.X.template topRows<kSize>()).array();
  bool flows = false;
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    const FlowResult result =
        flow<Dim>(law, axes, part == parts ? e_tr : Deviator<Dim>(e_n + share * (e_tr - e_n)), share,
                  dt / parts, flowing);
    if (result == FlowResult::Failed) return false;
    flows |= result == FlowResult::Flows;
  }

  const Deviator<Dim> e = e_tr - flowing.plasticStrain;
  MandelVector<Dim> T = basis * (2.0 * moduli_.mu * e).matrix();
  T.template head<3>().array() += moduli_.kappa * volume;
  MandelMatrix<Dim> D = 2.0 * moduli_.mu * basis *
                        (DeviatorMatrix<Dim>::Identity() - flowing.dPlasticStrain) * basis.transpose();
  D.template topLeftCorner<3, 3>().array() += moduli_.kappa;
  strain.setResponse(T, D, out);
  out.strainEnergy = 0.5 * moduli_.kappa * volume * volume + moduli_.mu * e.square().sum();
  out.plasticWork = flows ? (moduli_.mu * (e_n + e) * flowing.plasticStrain).sum() : 0.0;

  next = old;
  const MandelVector<Dim> E = flows ? MandelVector<Dim>(E_tr - basis * flowing.plasticStrain.matrix()) : E_tr;
  next.E.template head<kSize>() = E;
  if (flows) {
    next.Fp_inv = isAdditive
                      ? exponential<Dim>(-plasticStrainOf<Dim>(old) - basis * flowing.plasticStrain.matrix())
                      : Eigen::Matrix3d(F.inverse() * strain.rotation() * exponential<Dim>(E));
    next.e_p = flowing.e_p;
    next.X.template topRows<kSize>() = basis * flowing.X.matrix();
  }
  return std::isfinite(out.tau.sum() + out.strainEnergy);
}

Eigen::Matrix3d Chaboche::elasticDeformation(const Eigen::Matrix3d& F, const State& state) const {
  if (parameters_.frame == StrainFrame::Updated)
    return pushedForward(Eigen::Matrix3d::Identity(), F * state.Fp_inv);
  const LogarithmicStrain<3> strain(F);
  const MandelVector<3> E = strain.value() - plasticStrainOf<3>(state);
  return pushedForward(Eigen::Matrix3d::Identity(), strain.rotation() * exponential<3>(E));
}

void check(const Chaboche::Parameters& law, const Problems& problems) {
  checkHardening(law.hardening, problems, "hardening");
  for (std::size_t k = 0; k < law.backStresses.size(); ++k) {
    const std::string key = fmt::format("back_stresses[{}]", k);
    const BackStress& back = law.backStresses[k];
    if (problems.clean(key) && back.exponent && back.recovery == 0.0)
      problems.report(
          key + ".exponent",
          "found an exponent of a back stress that does not recover; allowed: with a recovery above 0.");
  }
  if (law.rate && problems.clean("hardening"))
    if (const auto* formula = std::get_if<FormulaRate::Parameters>(&*law.rate)) {
      const Hardening hardening = HardeningLaws::make(law.hardening);
      check(*formula, problems, "rate", [&](double e) { return hardeningAt(hardening, e).sigma_y; });
    }
  if (law.hill) check(*law.hill, problems, "hill");
}

void checkInPlane(const Chaboche::Parameters& law, const Problems& problems) {
  if (law.hill) checkInPlane(*law.hill, problems, "hill");
}

template bool Chaboche::evaluate<2>(const Eigen::Matrix3d&, double, const State&, State&,
                                    MaterialResponse<2>&) const;
template bool Chaboche::evaluate<3>(const Eigen::Matrix3d&, double, const State&, State&,
                                    MaterialResponse<3>&) const;

}  // namespace burnish::inline material
