#pragma once
#include "engine/material/voce_hardening.h"

namespace burnish::inline material {

/// σ_y = σ_0 + (σ_∞ − σ_0)(1 − exp(−β e)) + h e.
struct VoceLinearHardening {
  static constexpr LawKind kind{"voce-linear",
                                "sigma0 + (sigma_inf - sigma0) (1 - exp(-beta ep)) + modulus ep."};

  VoceHardening voce{};
  double modulus = 0.0;  ///< h

  double sigma_y(double e) const { return voce.sigma_y(e) + modulus * e; }
  double slope(double e) const { return voce.slope(e) + modulus; }
  double work(double e) const { return voce.work(e) + 0.5 * modulus * e * e; }
};

template <class Visitor>
void describe(Visitor& v, VoceLinearHardening& s) {
  v.field("sigma0", s.voce.sigma0, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at the start.");
  v.field("sigma_inf", s.voce.sigmaInf, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at saturation of the exponential part.");
  v.field("beta", s.voce.beta, {.required = true, .atLeast = 0}, "Rate of saturation.");
  v.field("modulus", s.modulus, {.required = true, .atLeast = 0, .unit = "stress"},
          "Slope of the linear part.");
}

}  // namespace burnish::inline material
