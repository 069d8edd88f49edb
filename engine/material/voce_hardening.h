#pragma once
#include "engine/material/law_list.h"
#include "engine/material/saturating_term.h"

namespace burnish::inline material {

/// σ_y = σ_0 + (σ_∞ − σ_0)(1 − exp(−β e)), eq. (44).
struct VoceHardening {
  static constexpr LawKind kind{"voce", "sigma0 + (sigma_inf - sigma0) (1 - exp(-beta ep))."};

  double sigma0 = 0.0;    ///< first yield stress
  double sigmaInf = 0.0;  ///< yield stress at saturation
  double beta = 0.0;      ///< rate of saturation

  double sigma_y(double e) const { return sigma0 + saturation().sigma_y(e); }
  double slope(double e) const { return saturation().slope(e); }
  double work(double e) const { return sigma0 * e + saturation().work(e); }

 private:
  SaturatingTerm saturation() const { return {sigmaInf - sigma0, beta}; }
};

template <class Visitor>
void describe(Visitor& v, VoceHardening& s) {
  v.field("sigma0", s.sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
  v.field("sigma_inf", s.sigmaInf, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at saturation.");
  v.field("beta", s.beta, {.required = true, .atLeast = 0}, "Rate of saturation.");
}

}  // namespace burnish::inline material
