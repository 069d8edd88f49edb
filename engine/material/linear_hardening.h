#pragma once
#include "engine/material/law_list.h"

namespace burnish::inline material {

/// σ_y = σ_0 + h e.
struct LinearHardening {
  static constexpr LawKind kind{"linear", "sigma0 + modulus ep; modulus 0 is perfect plasticity."};

  double sigma0 = 0.0;
  double modulus = 0.0;  ///< h

  double sigma_y(double e) const { return sigma0 + modulus * e; }
  double slope(double) const { return modulus; }
  double work(double e) const { return (sigma0 + 0.5 * modulus * e) * e; }
};

template <class Visitor>
void describe(Visitor& v, LinearHardening& s) {
  v.field("sigma0", s.sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
  v.field("modulus", s.modulus, {.required = true, .atLeast = 0, .unit = "stress"},
          "Increase of the yield stress per unit of plastic strain.");
}

}  // namespace burnish::inline material
