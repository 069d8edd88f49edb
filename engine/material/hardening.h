#pragma once
#include <cmath>
#include <variant>

#include "engine/material/formula_hardening.h"
#include "engine/material/table_hardening.h"

/// Hardening laws: the yield stress σ_y as a function of the equivalent plastic strain e >= 0. Every law has
///   sigma_y(e)   the yield stress,
///   slope(e)     its derivative (from the right where a law has a corner),
///   work(e)      H(e) = ∫_0^e σ_y.
namespace burnish {

/// A stress that grows from 0 to q: q (1 − exp(−β e)), β >= 0.
struct SaturatingTerm {
  double q;
  double beta;

  double sigma_y(double e) const { return q * (1.0 - std::exp(-beta * e)); }
  double slope(double e) const { return q * beta * std::exp(-beta * e); }
  double work(double e) const { return beta == 0.0 ? 0.0 : q * (e + std::expm1(-beta * e) / beta); }
};

/// σ_y = σ_0 + (σ_∞ − σ_0)(1 − exp(−β e)), eq. (44).
struct VoceHardening {
  double sigma0;
  double sigmaInf;
  double beta;

  double sigma_y(double e) const { return sigma0 + saturation().sigma_y(e); }
  double slope(double e) const { return saturation().slope(e); }
  double work(double e) const { return sigma0 * e + saturation().work(e); }

 private:
  SaturatingTerm saturation() const { return {sigmaInf - sigma0, beta}; }
};

/// σ_y = σ_0 + q_1 (1 − exp(−β_1 e)) + q_2 (1 − exp(−β_2 e)).
struct TwoTermVoceHardening {
  double sigma0;
  SaturatingTerm first;
  SaturatingTerm second;

  double sigma_y(double e) const { return sigma0 + first.sigma_y(e) + second.sigma_y(e); }
  double slope(double e) const { return first.slope(e) + second.slope(e); }
  double work(double e) const { return sigma0 * e + first.work(e) + second.work(e); }
};

/// σ_y = σ_0 + h e.
struct LinearHardening {
  double sigma0;
  double modulus;

  double sigma_y(double e) const { return sigma0 + modulus * e; }
  double slope(double) const { return modulus; }
  double work(double e) const { return (sigma0 + 0.5 * modulus * e) * e; }
};

/// σ_y = σ_0 + (σ_∞ − σ_0)(1 − exp(−β e)) + h e.
struct VoceLinearHardening {
  VoceHardening voce;
  double modulus;

  double sigma_y(double e) const { return voce.sigma_y(e) + modulus * e; }
  double slope(double e) const { return voce.slope(e) + modulus; }
  double work(double e) const { return voce.work(e) + 0.5 * modulus * e * e; }
};

using Hardening = std::variant<VoceHardening, TwoTermVoceHardening, LinearHardening, VoceLinearHardening,
                               TableHardening, FormulaHardening>;

}  // namespace burnish
