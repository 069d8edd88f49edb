#pragma once
#include "engine/material/law_list.h"
#include "engine/material/saturating_term.h"

namespace burnish::inline material {

/// σ_y = σ_0 + q_1 (1 − exp(−β_1 e)) + q_2 (1 − exp(−β_2 e)).
struct TwoTermVoceHardening {
  static constexpr LawKind kind{"two-term-voce",
                                "sigma0 + q1 (1 - exp(-beta1 ep)) + q2 (1 - exp(-beta2 ep))."};

  double sigma0 = 0.0;
  SaturatingTerm first{};
  SaturatingTerm second{};

  double sigma_y(double e) const { return sigma0 + first.sigma_y(e) + second.sigma_y(e); }
  double slope(double e) const { return first.slope(e) + second.slope(e); }
  double work(double e) const { return sigma0 * e + first.work(e) + second.work(e); }
};

template <class Visitor>
void describe(Visitor& v, TwoTermVoceHardening& s) {
  v.field("sigma0", s.sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
  v.field("q1", s.first.q, {.required = true, .atLeast = 0, .unit = "stress"},
          "Hardening of the first term.");
  v.field("beta1", s.first.beta, {.required = true, .atLeast = 0}, "Rate of saturation of the first term.");
  v.field("q2", s.second.q, {.required = true, .atLeast = 0, .unit = "stress"},
          "Hardening of the second term.");
  v.field("beta2", s.second.beta, {.required = true, .atLeast = 0}, "Rate of saturation of the second term.");
}

}  // namespace burnish::inline material
