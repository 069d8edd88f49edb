#include "engine/material/return_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burnish::inline material {
namespace {

constexpr double kTwoThirds = 2.0 / 3.0;
constexpr int kMaxIterations = 100;
constexpr double kSmallStep = 1e-8;  // relative; as Newton is quadratic, what is left after it is round-off
constexpr double kRoundOff = 1e-15;
constexpr double kYieldError = 1e-12;
constexpr double kNearby = 0.01;  // strains over which an elastic law is almost linear

double length(const Eigen::Array3d& v) {
  return v.matrix().norm();
}

/// The unknowns are e and q = Δγ/‖s‖. For a fixed q, e + q s(e) = e_tr has one solution e(q), as s is the
/// gradient of a convex energy, and ‖s(e(q))‖ decreases while Δγ grows with q.
struct Linearisation {
  Eigen::Array3d i;  // with M = diag(modulus): 1/(1 + q modulus)
  Eigen::Array3d y;  // modulus i
  Eigen::Array3d w;  // i / Σ i
  double q;

  Linearisation(const Eigen::Array3d& modulus, double q_)
      : i((1.0 + q_ * modulus).inverse()), y(modulus * i), w(i * (1.0 / i.sum())), q(q_) {}

  /// (1 + q ds/de)^{-1} v for a deviator v.
  Eigen::Array3d strain(const Eigen::Array3d& v) const { return i * v - w * (i * v).sum(); }

  /// ds/de (1 + q ds/de)^{-1} v for a deviator v.
  Eigen::Array3d stress(const Eigen::Array3d& v) const { return y * v - w * (y * v).sum(); }

  /// The matrix of `stress`, symmetric, annihilating (1,1,1); free of cancellation for q → 0.
  Eigen::Matrix3d stressMatrix() const {
    const double scale = 1.0 / i.sum();
    const double mean = y.sum() / 3.0;
    Eigen::Matrix3d E;
    for (int A = 0; A < 3; ++A)
      for (int B = 0; B < 3; ++B)
        E(A, B) = scale * (q * y[A] * y[B] - y[A] - y[B] + mean) + (A == B ? y[A] : 0.0);
    return E;
  }
};

struct Unknowns {
  Eigen::Array3d e;
  double q;
};

/// Exact for the Hencky energy when the yield stress does not depend on Δγ.
Unknowns startingPoint(double mu, const Hardening& hardening, const Eigen::Array3d& e_tr, double e_p_old) {
  const double norm = length(e_tr);
  const auto elasticNorm = [&](double deltaGamma) {
    const double sigma_y = hardeningAt(hardening, e_p_old + kRootTwoThirds * deltaGamma).sigma_y;
    return std::min(norm, kRootTwoThirds * sigma_y / (2.0 * mu));
  };
  const double refined = elasticNorm(norm - elasticNorm(0.0));
  return {e_tr * (refined / norm), (norm - refined) / (2.0 * mu * refined)};
}

}  // namespace

DeviatoricLaw::Answer DeviatoricLaw::operator()(const Eigen::Array3d& e) const {
  if (law == ElasticLaw::Hencky)
    return {2.0 * mu * e, Eigen::Array3d::Constant(2.0 * mu), mu * e.square().sum()};
  const Eigen::Array3d stretch{std::expm1(2.0 * e[0]), std::expm1(2.0 * e[1]), std::expm1(2.0 * e[2])};
  const double sum = stretch.sum();  // Σ λ̄_A² − 3
  return {mu * (stretch - sum / 3.0), 2.0 * mu * (1.0 + stretch), 0.5 * mu * sum};
}

HardeningPoint hardeningAt(const Hardening& hardening, double e_p) {
  return std::visit(
      [e_p](const auto& law) {
        return HardeningPoint{law.sigma_y(e_p), law.slope(e_p)};
      },
      hardening);
}

PrincipalState elasticState(const DeviatoricLaw& law, const Eigen::Array3d& e_tr, double e_p) {
  const auto [s, modulus, energy] = law(e_tr);
  return {e_tr, s, Linearisation(modulus, 0.0).stressMatrix(), modulus, energy, e_p};
}

/// Newton for (e, q) at once; where its step leaves the bracket of q, the bracket is halved, or e alone is
/// improved.
std::optional<PrincipalState> returnMap(const DeviatoricLaw& law, const Hardening& hardening,
                                        const Eigen::Array3d& e_tr, double e_p_old) {
  auto [e, q] = startingPoint(law.mu, hardening, e_tr, e_p_old);
  double lower = 0.0;
  double upper = std::numeric_limits<double>::infinity();
  bool lastStepWasSmall = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const auto [s, modulus, energy] = law(e);
    const double norm = length(s);
    if (!(norm > 0.0) || !std::isfinite(norm)) return std::nullopt;
    const double e_p = e_p_old + kRootTwoThirds * q * norm;
    const auto [sigma_y, slope] = hardeningAt(hardening, e_p);
    const Linearisation linear(modulus, q);
    const Eigen::Array3d n = s * (1.0 / norm);
    const Eigen::Array3d En = linear.stress(n);
    // δf = a n·δs − ⅔ slope ‖s‖ δq, with δs = −stress(r + s δq)
    const double a = 1.0 - kTwoThirds * slope * q;
    const double denominator = kTwoThirds * slope + a * (n * En).sum();
    const double f = norm - kRootTwoThirds * sigma_y;
    if (lastStepWasSmall && std::abs(f) < kYieldError * norm) {
      const Eigen::Matrix3d D =
          linear.stressMatrix() - (a / denominator) * En.matrix() * En.matrix().transpose();
      return PrincipalState{e, s, D, linear.y, energy, e_p};
    }

    const Eigen::Array3d r = e + q * s - e_tr;
    const Eigen::Array3d correction = linear.strain(r);  // e − e(q) to first order
    // The sign of f at e(q) is known where f is larger than what the error of e contributes to it.
    const bool signIsKnown = length(correction) < kNearby && std::abs(f) > 2.0 * length(modulus * correction);
    if (signIsKnown) (f > 0.0 ? lower : upper) = q;
    double dq = (f - a * (En * r).sum()) / (denominator * norm);
    const bool inside = q + dq > lower && q + dq < upper;
    if (!inside) dq = signIsKnown ? 0.5 * (lower + std::min(upper, 4.0 * q + 1.0 / law.mu)) - q : 0.0;
    const Eigen::Array3d de = -correction - linear.strain(s) * dq;
    e += de;
    e -= e.mean();  // round-off must not change the volume
    q += dq;
    lastStepWasSmall = length(de) + norm * std::abs(dq) < kSmallStep * length(e) + kRoundOff * length(e_tr);
  }
  return std::nullopt;
}

}  // namespace burnish::inline material
