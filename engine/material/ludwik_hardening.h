#pragma once
#include "engine/material/law_list.h"
#include "engine/material/power_term.h"

namespace burnish::inline material {

/// Ludwik: σ_y = σ_0 + B e^n.
struct LudwikHardening {
  static constexpr LawKind kind{"ludwik", "sigma0 + modulus ep^exponent."};

  double sigma0 = 0.0;
  PowerTerm power{};

  double sigma_y(double e) const { return sigma0 + power.sigma_y(e); }
  double slope(double e) const { return power.slope(e); }
  double work(double e) const { return sigma0 * e + power.work(e); }
};

template <class Visitor>
void describe(Visitor& v, LudwikHardening& s) {
  v.field("sigma0", s.sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
  v.field("modulus", s.power.q, {.required = true, .atLeast = 0, .unit = "stress"},
          "Increase of the yield stress up to a plastic strain of one.");
  v.field("exponent", s.power.n, {.required = true, .above = 0, .atMost = 1},
          "Exponent of the plastic strain.");
}

}  // namespace burnish::inline material
