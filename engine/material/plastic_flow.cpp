#include "engine/material/plastic_flow.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/material/return_map.h"

namespace burnish::inline material {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kYieldTolerance =
    1e-11;  // relative: states that a converged step has left on the surface are elastic
constexpr double kSmallStep = 1e-8;  // relative; as Newton is quadratic, what is left after it is round-off
constexpr double kRoundOff = 4e-15;

/// Yield stress at a plastic strain p of the step, and its derivatives.
struct YieldStress {
  double value;
  double byUnknown;  ///< p and rate change together
  double byStrain;   ///< with the equivalent plastic strain before the step, at constant p
};

/// The unknown u of the scalar equation: the plastic strain p of the step or, with Norton's law, the ratio v of the
/// overstress to K, p = Δt v^N, as the slope of the overstress in p is infinite at zero.
class Unknown {
 public:
  Unknown(const FlowLaw& law, double e_p, double dt) : law_(law), e_p_(e_p), dt_(dt) {
    if (!law.rate->has_value() || !std::isfinite(dt)) return;
    norton_ = std::get_if<NortonRate>(&**law.rate);
    johnsonCook_ = std::get_if<JohnsonCookRate>(&**law.rate);
    formula_ = std::get_if<FormulaRate>(&**law.rate);
  }

  /// For an upper bound of p, and the stress by which the trial state is beyond the yield surface.
  double upperEnd(double strain, double excess) const {
    return norton_ ? std::min(std::pow(strain / dt_, 1.0 / norton_->N), excess / norton_->K) : strain;
  }

  double at(double strain) const { return norton_ ? std::pow(strain / dt_, 1.0 / norton_->N) : strain; }
  double strain(double u) const { return norton_ ? dt_ * std::pow(u, norton_->N) : u; }
  double slope(double u) const { return norton_ ? dt_ * norton_->N * std::pow(u, norton_->N - 1.0) : 1.0; }

  YieldStress yieldStress(double u) const {
    const double p = strain(u);
    const auto [sigma_y, hardening] = hardeningAt(*law_.hardening, e_p_ + p);
    if (norton_) return {sigma_y + norton_->K * u, hardening * slope(u) + norton_->K, hardening};
    if (formula_) {
      const FormulaRate::FlowStress flow = formula_->at(sigma_y, e_p_ + p, p / dt_);
      const double byStrain = flow.byYieldStress * hardening + flow.byStrain;
      return {flow.value, byStrain + flow.byRate / dt_, byStrain};
    }
    const double ratio = johnsonCook_ ? p / (dt_ * johnsonCook_->rate0) : 0.0;
    if (!(ratio > 1.0)) return {sigma_y, hardening, hardening};
    const double factor = 1.0 + johnsonCook_->C * std::log(ratio);
    return {sigma_y * factor, hardening * factor + sigma_y * johnsonCook_->C / p, hardening * factor};
  }

 private:
  const FlowLaw& law_;
  double e_p_, dt_;
  const NortonRate* norton_ = nullptr;
  const JohnsonCookRate* johnsonCook_ = nullptr;
  const FormulaRate* formula_ = nullptr;
};

/// The scalar equation g(u) = σ_H(ξ) − Y = 0 at one u, and what follows from it. Derivatives with respect to u end in _u.
template <int Dim>
struct FlowPoint {
  using Vector = Deviator<Dim>;

  double p, p_u;
  YieldStress Y;
  std::array<double, kMostBackStresses> theta, psi;
  double m, m_u;  ///< (2μ Δe + ⅔ ΣC ψ)/Y: ξ = Z/(1 + m η)
  Vector A_u;     ///< derivative of Z = dev T_tr − Σθ X_n
  Vector G;       ///< 1/(1 + m η)
  Vector xi, a;   ///< a = ηξ/σ_H
  double g, g_u;

  FlowPoint(const FlowLaw& law, const YieldAxes<Dim>& axes, const Unknown& unknown, const Vector& trialStress,
            const FlowState<Dim>& state, double u)
      : p(unknown.strain(u)), p_u(unknown.slope(u)), Y(unknown.yieldStress(u)), A_u(Vector::Zero()) {
    Vector Z = trialStress;
    double sum = 2.0 * law.mu * p, sum_p = 2.0 * law.mu;
    for (std::size_t i = 0; i < law.backStresses->size(); ++i) {
      const auto& [C, gamma, exponent] = (*law.backStresses)[i];
      const auto X = state.X.col(static_cast<Eigen::Index>(i));
      theta[i] = std::exp(-gamma * p);
      psi[i] = gamma == 0.0 ? p : -std::expm1(-gamma * p) / gamma;
      Z -= theta[i] * X;
      A_u += gamma * theta[i] * p_u * X;
      sum += 2.0 / 3.0 * C * psi[i];
      sum_p += 2.0 / 3.0 * C * theta[i];
    }
    m = sum / Y.value;
    m_u = (sum_p * p_u - m * Y.byUnknown) / Y.value;
    G = (1.0 + m * axes.eta).inverse();
    xi = G * Z;
    const double norm = axes.norm(xi);
    a = axes.eta * xi / norm;
    g = norm - Y.value;
    g_u = (a * G * (A_u - m_u * axes.eta * xi)).sum() - Y.byUnknown;
  }
};

/// Newton from the upper end of the bracket, which is halved where a step leaves it.
template <int Dim>
std::optional<FlowPoint<Dim>> solveFlow(const FlowLaw& law, const YieldAxes<Dim>& axes,
                                        const Unknown& unknown, const Deviator<Dim>& trialStress,
                                        const FlowState<Dim>& state, double upper, double trialNorm) {
  double lower = 0.0, high = std::numeric_limits<double>::infinity(), u = upper;
  bool lastStepWasSmall = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const FlowPoint<Dim> point(law, axes, unknown, trialStress, state, u);
    if (!std::isfinite(point.Y.value)) return std::nullopt;
    const bool isUsable = point.Y.value > 0.0 && std::isfinite(point.g) && point.g_u < 0.0;
    if (isUsable && lastStepWasSmall) return point;
    if (!isUsable || point.g <= 0.0)
      high = std::min(high, u);
    else
      lower = std::max(lower, u);
    const double step = isUsable ? -point.g / point.g_u : -u;
    double next = u + step;
    lastStepWasSmall =
        isUsable && (std::abs(step) <= kSmallStep * u || std::abs(point.g) <= kRoundOff * trialNorm);
    if (!lastStepWasSmall && !(next > lower && next < high))
      next = std::isfinite(high) ? 0.5 * (lower + high) : 2.0 * u;
    if (!(next > 0.0)) return std::nullopt;
    u = next;
  }
  return std::nullopt;
}

/// A back stress behind a step of the plastic strain `strain`, and its derivatives.
template <int Dim>
struct BackStressPoint {
  Deviator<Dim> X;
  DeviatorMatrix<Dim> byStrain, byOld;
};

/// p: equivalent plastic strain of the step; p_strain: its derivative.
template <int Dim>
BackStressPoint<Dim> recoveredAsArmstrongAndFrederick(const BackStress& law, const Deviator<Dim>& old,
                                                      const Deviator<Dim>& strain, double p,
                                                      const Deviator<Dim>& p_strain) {
  const double C = 2.0 / 3.0 * law.modulus, gamma = law.recovery;
  const double theta = std::exp(-gamma * p), psi = gamma == 0.0 ? p : -std::expm1(-gamma * p) / gamma;
  const auto unit = DeviatorMatrix<Dim>::Identity();
  const Deviator<Dim> byP = C * (theta - psi / p) / p * strain - gamma * theta * old;
  return {theta * old + C * psi / p * strain,
          C * psi / p * unit + byP.matrix() * p_strain.matrix().transpose(), theta * unit};
}

/// The root u of u + B u^(m+1) = tau, all of them positive.
double recoveredShare(double B, double m, double tau) {
  constexpr int kMost = 100;
  double u = std::min(tau, std::pow(tau / B, 1.0 / (m + 1.0)));
  // The left side is convex: from above, u falls towards the root.
  for (int iteration = 0; iteration < kMost; ++iteration) {
    const double power = B * std::pow(u, m);
    const double next = u - (u + power * u - tau) / (1.0 + (m + 1.0) * power);
    if (!(next < u * (1.0 - kRoundOff))) return next;
    u = next;
  }
  return u;
}

/// X = θ X_tr with X_tr = X_n + ⅔ C ΔE^p, so that X̄/r = u follows from its value τ for X_tr: u + B u^(m+1) = τ with
/// B = γ ⟨ΔE^p : X_tr⟩/X̄_tr.
template <int Dim>
BackStressPoint<Dim> recoveredAsOhnoAndWang(const BackStress& law, const Deviator<Dim>& old,
                                            const Deviator<Dim>& strain) {
  using Row = Eigen::Matrix<double, 1, kDeviator<Dim>>;
  using Matrix = DeviatorMatrix<Dim>;
  const double C = 2.0 / 3.0 * law.modulus, r = law.modulus / law.recovery, m = *law.exponent;
  const auto unit = Matrix::Identity();
  const Deviator<Dim> trial = old + C * strain;
  const double size = std::sqrt(1.5) * trial.matrix().norm(), work = (strain * trial).sum();
  if (!(work > 0.0) || !(law.recovery * work / size > 0.0)) return {trial, C * unit, unit};
  const double tau = size / r, u = recoveredShare(law.recovery * work / size, m, tau);
  const Row tau_trial = 1.5 / (size * r) * trial.matrix().transpose();
  const double stiffness = 1.0 + (m + 1.0) * (tau - u) / u;
  // trialBy: derivative of X_tr; workBy: of the work.
  const auto derivative = [&](const Matrix& trialBy, const Row& workBy) -> Matrix {
    const Row tauBy = tau_trial * trialBy;
    const Row uBy = (tauBy - (tau - u) * (workBy / work - tauBy / tau)) / stiffness;
    return u / tau * trialBy + trial.matrix() * (uBy - u / tau * tauBy) / tau;
  };
  const Row strainRow = strain.matrix().transpose();
  return {u / tau * trial, derivative(C * unit, trial.matrix().transpose() + C * strainRow),
          derivative(unit, strainRow)};
}

/// The equation R(ΔE^p) = 2μ ΔE^p + ΣX + Y ΔE^p/(η p) − dev T_tr = 0 at one ΔE^p, for recoveries that depend on its
/// direction.
template <int Dim>
struct TensorFlowPoint {
  using Vector = Deviator<Dim>;
  using Matrix = DeviatorMatrix<Dim>;

  double p;
  Vector p_strain;  ///< derivative of p
  YieldStress Y;
  std::array<BackStressPoint<Dim>, kMostBackStresses> back;
  Vector residual;
  Matrix slope;

  TensorFlowPoint(const FlowLaw& law, const YieldAxes<Dim>& axes, const Unknown& unknown,
                  const Vector& trialStress, const FlowState<Dim>& state, const Vector& strain)
      : p(std::sqrt((strain.square() / axes.eta).sum())),
        p_strain(strain / (axes.eta * p)),
        Y(unknown.yieldStress(unknown.at(p))),
        residual(2.0 * law.mu * strain + Y.value * p_strain - trialStress) {
    const double Y_p = Y.byUnknown / unknown.slope(unknown.at(p));
    slope = (2.0 * law.mu + Y.value / (p * axes.eta)).matrix().asDiagonal();
    slope += (Y_p - Y.value / p) * p_strain.matrix() * p_strain.matrix().transpose();
    for (std::size_t i = 0; i < law.backStresses->size(); ++i) {
      const BackStress& one = (*law.backStresses)[i];
      const Vector old = state.X.col(static_cast<Eigen::Index>(i));
      back[i] = one.exponent ? recoveredAsOhnoAndWang<Dim>(one, old, strain)
                             : recoveredAsArmstrongAndFrederick<Dim>(one, old, strain, p, p_strain);
      residual += back[i].X;
      slope += back[i].byStrain;
    }
  }

  bool isUsable() const { return Y.value > 0.0 && std::isfinite(Y.value + residual.sum() + slope.sum()); }
};

/// Newton from the plastic strain `start`, by shorter steps where the residual would grow.
template <int Dim>
std::optional<std::pair<Deviator<Dim>, TensorFlowPoint<Dim>>> solveTensorFlow(
    const FlowLaw& law, const YieldAxes<Dim>& axes, const Unknown& unknown, const Deviator<Dim>& trialStress,
    const FlowState<Dim>& state, const Deviator<Dim>& start) {
  constexpr int kMostHalvings = 40;
  Deviator<Dim> strain = start;
  TensorFlowPoint<Dim> point(law, axes, unknown, trialStress, state, strain);
  if (!point.isUsable()) return std::nullopt;
  const double roundOff = kRoundOff * trialStress.matrix().norm();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Deviator<Dim> step = -point.slope.partialPivLu().solve(point.residual.matrix()).array();
    const double before = point.residual.matrix().norm();
    const bool isLast = before <= roundOff || step.matrix().norm() <= kSmallStep * strain.matrix().norm();
    double share = 1.0;
    for (int halvings = 0;; ++halvings, share *= 0.5) {
      const Deviator<Dim> next = strain + share * step;
      const TensorFlowPoint<Dim> there(law, axes, unknown, trialStress, state, next);
      if (there.isUsable() && (isLast || there.residual.matrix().norm() < before)) {
        strain = next;
        point = there;
        break;
      }
      if (halvings == kMostHalvings) return std::nullopt;
    }
    if (isLast) return std::pair{strain, point};
  }
  return std::nullopt;
}

/// Goes on by the plastic strain that solves the tensor's equation, with derivatives as in `flow`.
template <int Dim>
void add(const Deviator<Dim>& strain, const TensorFlowPoint<Dim>& s, double mu, double part,
         Eigen::Index count, FlowState<Dim>& state) {
  using Matrix = DeviatorMatrix<Dim>;
  Matrix right = 2.0 * mu * (part * Matrix::Identity() - state.dPlasticStrain);
  right -= s.Y.byStrain * s.p_strain.matrix() * state.de_p;
  for (Eigen::Index i = 0; i < count; ++i)
    right -= s.back[static_cast<std::size_t>(i)].byOld * state.dX[static_cast<std::size_t>(i)];
  const Matrix dStrain = s.slope.partialPivLu().solve(right);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    state.dX[n] = s.back[n].byStrain * dStrain + s.back[n].byOld * state.dX[n];
    state.X.col(i) = s.back[n].X;
  }
  state.dPlasticStrain += dStrain;
  state.de_p += s.p_strain.matrix().transpose() * dStrain;
  state.plasticStrain += strain;
  state.e_p += s.p;
}

}  // namespace

template <int Dim>
YieldAxes<Dim>::YieldAxes(const std::optional<HillYield>& hill) {
  using std::numbers::sqrt2;
  const double sqrt6 = sqrt2 * std::numbers::sqrt3;
  basis.setZero();
  basis.template topLeftCorner<3, 2>() << 1.0 / sqrt2, 1.0 / sqrt6, -1.0 / sqrt2, 1.0 / sqrt6, 0.0,
      -2.0 / sqrt6;
  for (int k = 3; k < kVoigt<Dim>; ++k) basis(k, k - 1) = 1.0;
  eta.setConstant(1.5);
  if (!hill) return;
  const auto [F, G, H, L, M, N] = hill->factors();
  MandelMatrix<3> inAxes = MandelMatrix<3>::Zero();
  inAxes.topLeftCorner<3, 3>() << G + H, -H, -G, -H, F + H, -F, -G, -F, F + G;
  inAxes.diagonal().tail<3>() << N, L, M;
  const MandelMatrix<3> rotation = mandelRotation<3>(hill->axes());
  const MandelMatrix<3> whole = rotation * inAxes * rotation.transpose();
  const Eigen::SelfAdjointEigenSolver<DeviatorMatrix<Dim>> solver(
      basis.transpose() * whole.topLeftCorner<kVoigt<Dim>, kVoigt<Dim>>() * basis);
  eta = solver.eigenvalues();
  basis = (basis * solver.eigenvectors()).eval();
}

template <int Dim>
double YieldAxes<Dim>::norm(const Deviator<Dim>& t) const {
  return std::sqrt((eta * t.square()).sum());
}

template <int Dim>
FlowResult flow(const FlowLaw& law, const YieldAxes<Dim>& axes, const Deviator<Dim>& strain, double part,
                double dt, FlowState<Dim>& state) {
  using Vector = Deviator<Dim>;
  using Matrix = DeviatorMatrix<Dim>;
  using Row = Eigen::Matrix<double, 1, kDeviator<Dim>>;
  const auto count = static_cast<Eigen::Index>(law.backStresses->size());

  // Elastic predictor
  const Vector trialStress = 2.0 * law.mu * (strain - state.plasticStrain);
  const double trialNorm = axes.norm(trialStress - state.X.leftCols(count).rowwise().sum());
  const double initial = hardeningAt(*law.hardening, state.e_p).sigma_y;
  const double excess = trialNorm - initial;
  if (!std::isfinite(trialNorm)) return FlowResult::Failed;
  if (excess <= kYieldTolerance * initial) return FlowResult::Elastic;

  // Return to the yield surface
  const Unknown unknown(law, state.e_p, dt);
  const double upper = unknown.upperEnd(excess / (2.0 * law.mu * axes.eta.minCoeff()), excess);
  const auto solution = solveFlow<Dim>(law, axes, unknown, trialStress, state, upper, trialNorm);
  if (!solution) return FlowResult::Failed;
  const FlowPoint<Dim>& s = *solution;
  if (std::ranges::any_of(*law.backStresses,
                          [](const BackStress& back) { return back.exponent.has_value(); })) {
    // So far recoveries were those of Armstrong and Frederick.
    const Vector start = s.p / s.Y.value * axes.eta * s.xi;
    const auto solved = solveTensorFlow<Dim>(law, axes, unknown, trialStress, state, start);
    if (!solved) return FlowResult::Failed;
    add<Dim>(solved->first, solved->second, law.mu, part, count, state);
    return FlowResult::Flows;
  }

  // Derivatives: r is what ξ changes by at constant u.
  const auto unit = Matrix::Identity();
  Matrix r = 2.0 * law.mu * (part * unit - state.dPlasticStrain);
  for (Eigen::Index i = 0; i < count; ++i)
    r -= s.theta[static_cast<std::size_t>(i)] * state.dX[static_cast<std::size_t>(i)];
  const Vector flowed = axes.eta * s.xi;  // ℍξ
  const double m_e = -s.m * s.Y.byStrain / s.Y.value;
  r -= (m_e * flowed).matrix() * state.de_p;
  r = s.G.matrix().asDiagonal() * r;
  const Row du = (s.a.matrix().transpose() * r - s.Y.byStrain * state.de_p) / -s.g_u;
  const Matrix dxi = r + (s.G * (s.A_u - s.m_u * flowed)).matrix() * du;
  const Matrix dFlowed = axes.eta.matrix().asDiagonal() * dxi;
  const double k = s.p / s.Y.value;
  const double k_u = (s.p_u - k * s.Y.byUnknown) / s.Y.value, k_e = -k * s.Y.byStrain / s.Y.value;
  state.dPlasticStrain += flowed.matrix() * (k_u * du + k_e * state.de_p) + k * dFlowed;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const auto& [C, gamma, exponent] = (*law.backStresses)[n];
    const double w = 2.0 / 3.0 * C * s.psi[n] / s.Y.value;
    const double w_u = (2.0 / 3.0 * C * s.theta[n] * s.p_u - w * s.Y.byUnknown) / s.Y.value;
    const double w_e = -w * s.Y.byStrain / s.Y.value;
    const Vector old = state.X.col(i);
    state.dX[n] = s.theta[n] * state.dX[n] + (w_u * flowed - gamma * s.theta[n] * s.p_u * old).matrix() * du +
                  (w_e * flowed).matrix() * state.de_p + w * dFlowed;
    state.X.col(i) = s.theta[n] * old + w * flowed;
  }
  state.de_p += s.p_u * du;
  state.plasticStrain += k * flowed;
  state.e_p += s.p;
  return FlowResult::Flows;
}

template struct YieldAxes<2>;
template struct YieldAxes<3>;
template FlowResult flow<2>(const FlowLaw&, const YieldAxes<2>&, const Deviator<2>&, double, double,
                            FlowState<2>&);
template FlowResult flow<3>(const FlowLaw&, const YieldAxes<3>&, const Deviator<3>&, double, double,
                            FlowState<3>&);

}  // namespace burnish::inline material
