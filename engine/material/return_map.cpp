#include "engine/material/return_map.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace burnish {
namespace {

constexpr double kTwoThirds = 2.0 / 3.0;
constexpr int kMaxIterations = 100;
constexpr double kSmallStep = 1e-8;  // relative; as Newton is quadratic, what is left after it is round-off
constexpr double kRoundOff = 1e-15;
constexpr double kYieldError = 1e-12;
constexpr double kNearby = 0.01;  // strains over which an elastic law is almost linear

/// Values in the three principal directions, of each lane.
struct Principal {
  Lanes of[3];

  Lanes sum() const { return of[0] + of[1] + of[2]; }
};

template <class F>
Principal principal(const F& f) {
  return {{f(0), f(1), f(2)}};
}
Principal operator*(const Principal& a, const Principal& b) {
  return principal([&](int A) { return a.of[A] * b.of[A]; });
}
Principal operator*(Lanes a, const Principal& b) {
  return principal([&](int A) { return a * b.of[A]; });
}
Principal operator+(const Principal& a, const Principal& b) {
  return principal([&](int A) { return a.of[A] + b.of[A]; });
}
Principal operator-(const Principal& a, const Principal& b) {
  return principal([&](int A) { return a.of[A] - b.of[A]; });
}
Principal operator-(const Principal& a, Lanes b) {
  return principal([&](int A) { return a.of[A] - b; });
}

Lanes squaredLength(const Principal& v) {
  return (v * v).sum();
}

/// Of the elastic law, as functions of the deviator e = dev ln λ.
struct Deviatoric {
  Principal s;        ///< deviatoric Kirchhoff stress
  Principal modulus;  ///< m with ds/de = P diag(m) P, P the projection on deviators
  Lanes energy;

  Deviatoric(const DeviatoricLaw& law, const Principal& e) {
    const double mu = law.mu;
    if (law.law == ElasticLaw::Hencky) {
      s = principal([&](int A) { return 2.0 * mu * e.of[A]; });
      modulus = principal([&](int) { return Lanes{} + 2.0 * mu; });
      energy = mu * squaredLength(e);
      return;
    }
    const Principal stretch = principal([&](int A) { return expm1(2.0 * e.of[A]); });
    const Lanes sum = stretch.sum();  // Σ λ̄_A² − 3
    s = principal([&](int A) { return mu * (stretch.of[A] - sum * (1.0 / 3.0)); });
    modulus = principal([&](int A) { return 2.0 * mu * (1.0 + stretch.of[A]); });
    energy = 0.5 * mu * sum;
  }
};

/// Yield stress and its derivative.
struct HardeningPoints {
  Lanes sigma_y, slope;
};

template <class Law>
HardeningPoints hardeningAt(const Law& law, Lanes e_p) {
  if constexpr (requires { law.sigma_y(e_p); }) {
    return {law.sigma_y(e_p), law.slope(e_p)};
  } else {
    HardeningPoints points;
    for (int k = 0; k < kLanes; ++k) {
      points.sigma_y[k] = law.sigma_y(e_p[k]);
      points.slope[k] = law.slope(e_p[k]);
    }
    return points;
  }
}

/// The unknowns are e and q = Δγ/‖s‖. For a fixed q, e + q s(e) = e_tr has one solution e(q), as s is the
/// gradient of a convex energy, and ‖s(e(q))‖ decreases while Δγ grows with q.
struct Linearisation {
  Principal i;  // with M = diag(modulus): 1/(1 + q modulus)
  Principal y;  // modulus i
  Lanes scale;  // 1 / Σ i
  Principal w;  // i / Σ i
  Lanes q;

  Linearisation(const Principal& modulus, Lanes q_)
      : i(principal([&](int A) { return 1.0 / (1.0 + q_ * modulus.of[A]); })),
        y(modulus * i),
        scale(1.0 / i.sum()),
        w(scale * i),
        q(q_) {}

  /// (1 + q ds/de)^{-1} v for a deviator v.
  Principal strain(const Principal& v) const { return i * v - (i * v).sum() * w; }

  /// ds/de (1 + q ds/de)^{-1} v for a deviator v.
  Principal stress(const Principal& v) const { return y * v - (y * v).sum() * w; }

  /// An entry of the matrix of `stress`, symmetric, annihilating (1,1,1); free of cancellation for q → 0.
  Lanes stressMatrix(int A, int B) const {
    const Lanes mean = y.sum() * (1.0 / 3.0);
    const Lanes entry = scale * (q * y.of[A] * y.of[B] - y.of[A] - y.of[B] + mean);
    return A == B ? entry + y.of[A] : entry;
  }
};

struct Unknowns {
  Principal e;
  Lanes q;
};

/// Exact for the Hencky energy when the yield stress does not depend on Δγ.
template <class Law>
Unknowns startingPoint(double mu, const Law& hardening, const Principal& e_tr, Lanes e_p_old) {
  const Lanes norm = sqrt(squaredLength(e_tr));
  const auto elasticNorm = [&](Lanes deltaGamma) {
    const Lanes sigma_y = hardeningAt(hardening, e_p_old + kRootTwoThirds * deltaGamma).sigma_y;
    const Lanes elastic = sigma_y * (kRootTwoThirds / (2.0 * mu));
    return elastic < norm ? elastic : norm;
  };
  const Lanes refined = elasticNorm(norm - elasticNorm(Lanes{}));
  return {(refined / norm) * e_tr, (norm - refined) / (2.0 * mu * refined)};
}

/// Newton for (e, q) at once; where its step leaves the bracket of q, the bracket is halved, or e alone is
/// improved. A lane that has come to its end, good or bad, stays as it is until all have.
template <class Law>
void solve(const DeviatoricLaw& law, const Law& hardening, const Principal& e_tr, Lanes e_p_old,
           std::span<std::optional<PrincipalState>> states) {
  auto [e, q] = startingPoint(law.mu, hardening, e_tr, e_p_old);
  const Lanes infinite = Lanes{} + std::numeric_limits<double>::infinity();
  const Lanes trialLength = sqrt(squaredLength(e_tr));
  Lanes lower{};
  Lanes upper = infinite;
  LaneMask lastStepWasSmall{};
  for (int iteration = 0;; ++iteration) {
    const Deviatoric elastic(law, e);
    const Principal& s = elastic.s;
    const Lanes norm = sqrt(squaredLength(s));
    const LaneMask isSound = (norm > 0.0) & (norm < infinite);
    const Lanes e_p = e_p_old + kRootTwoThirds * (q * norm);
    const auto [sigma_y, slope] = hardeningAt(hardening, e_p);
    const Linearisation linear(elastic.modulus, q);
    const Principal n = (1.0 / norm) * s;
    const Principal En = linear.stress(n);
    // δf = a n·δs − ⅔ slope ‖s‖ δq, with δs = −stress(r + s δq)
    const Lanes a = 1.0 - kTwoThirds * slope * q;
    const Lanes denominator = kTwoThirds * slope + a * (n * En).sum();
    const Lanes f = norm - kRootTwoThirds * sigma_y;
    const LaneMask isSolved = isSound & lastStepWasSmall & (abs(f) < kYieldError * norm);
    const LaneMask isAtEnd = isSolved | ~isSound;
    if (iteration == kMaxIterations || !any(~isAtEnd)) {
      const Lanes factor = a / denominator;
      Lanes D[3][3];
      for (int A = 0; A < 3; ++A)
        for (int B = 0; B < 3; ++B) D[A][B] = linear.stressMatrix(A, B) - factor * En.of[A] * En.of[B];
      for (std::size_t k = 0; k < states.size(); ++k) {
        states[k].reset();
        if (isSolved[k] == 0) continue;
        PrincipalState& state = states[k].emplace();
        for (int A = 0; A < 3; ++A) {
          state.e[A] = e.of[A][k];
          state.s[A] = s.of[A][k];
          state.modulus[A] = linear.y.of[A][k];
          for (int B = 0; B < 3; ++B) state.D(A, B) = D[A][B][k];
        }
        state.energy = elastic.energy[k];
        state.e_p = e_p[k];
      }
      return;
    }

    const Principal r = e + q * s - e_tr;
    const Principal correction = linear.strain(r);  // e − e(q) to first order
    // The sign of f at e(q) is known where f is larger than what the error of e contributes to it.
    const LaneMask signIsKnown = (squaredLength(correction) < kNearby * kNearby) &
                                 (f * f > 4.0 * squaredLength(elastic.modulus * correction));
    lower = (signIsKnown & (f > 0.0)) ? q : lower;
    upper = (signIsKnown & ~(f > 0.0)) ? q : upper;
    const Lanes newton = (f - a * (En * r).sum()) / (denominator * norm);
    const LaneMask isInside = (q + newton > lower) & (q + newton < upper);
    const Lanes reach = 4.0 * q + 1.0 / law.mu;
    const Lanes halved = 0.5 * (lower + (upper < reach ? upper : reach)) - q;
    const Lanes dq = isInside ? newton : (signIsKnown ? halved : Lanes{});
    const Principal de = (Lanes{} - 1.0) * correction - dq * linear.strain(s);
    Principal next = e + de;
    next = next - next.sum() * (1.0 / 3.0);  // round-off must not change the volume
    const Lanes step = sqrt(squaredLength(de)) + norm * abs(dq);
    for (int A = 0; A < 3; ++A) e.of[A] = isAtEnd ? e.of[A] : next.of[A];
    q = isAtEnd ? q : q + dq;
    const LaneMask isSmall = step < kSmallStep * sqrt(squaredLength(e)) + kRoundOff * trialLength;
    lastStepWasSmall = isAtEnd ? lastStepWasSmall : isSmall;
  }
}

}  // namespace

PrincipalState elasticHenckyState(double mu, const TrialState& trial) {
  Eigen::Matrix3d D = Eigen::Matrix3d::Constant(-2.0 * mu / 3.0);
  D.diagonal().array() += 2.0 * mu;
  return {trial.e,  2.0 * mu * trial.e, D, Eigen::Array3d::Constant(2.0 * mu), mu * trial.e.square().sum(),
          trial.e_p};
}

void returnMap(const DeviatoricLaw& law, const Hardening& hardening, std::span<const TrialState> trials,
               std::span<std::optional<PrincipalState>> states) {
  assert(!trials.empty() && trials.size() <= kLanes && states.size() == trials.size());
  Principal e_tr;
  Lanes e_p;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const TrialState& trial = trials[k < trials.size() ? k : 0];  // lanes without a point do as the first one
    for (int A = 0; A < 3; ++A) e_tr.of[A][k] = trial.e[A];
    e_p[k] = trial.e_p;
  }
  std::visit([&](const auto& curve) { solve(law, curve, e_tr, e_p, states); }, hardening);
}

}  // namespace burnish
