#pragma once
#include "engine/material/law_list.h"
#include "engine/material/power_term.h"

namespace burnish::inline material {

/// Swift: σ_y = K (e_0 + e)^n.
struct SwiftHardening {
  static constexpr LawKind kind{"swift", "modulus (ep0 + ep)^exponent."};

  PowerTerm power{};

  double sigma_y(double e) const { return power.sigma_y(e); }
  double slope(double e) const { return power.slope(e); }
  double work(double e) const { return power.work(e); }
};

template <class Visitor>
void describe(Visitor& v, SwiftHardening& s) {
  v.field("modulus", s.power.q, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress where the sum of the strains is one.");
  v.field("ep0", s.power.shift, {.required = true, .atLeast = 1e-8},
          "Strain that is added to the plastic strain.");
  v.field("exponent", s.power.n, {.required = true, .above = 0, .atMost = 1}, "Exponent of the sum.");
}

}  // namespace burnish::inline material
