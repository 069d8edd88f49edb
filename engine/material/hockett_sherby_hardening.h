#pragma once
#include "engine/material/law_list.h"

namespace burnish::inline material {

/// Hockett and Sherby: σ_y = σ_s − (σ_s − σ_0) exp(−(N e)^p).
struct HockettSherbyHardening {
  static constexpr LawKind kind{"hockett-sherby",
                                "sigma_inf - (sigma_inf - sigma0) exp(-(rate ep)^exponent)."};

  double sigma0 = 0.0;    ///< first yield stress
  double sigmaInf = 0.0;  ///< yield stress at saturation
  double rate = 0.0;      ///< N
  double exponent = 1.0;  ///< p

  double sigma_y(double e) const;
  double slope(double e) const;
  double work(double e) const;
};

template <class Visitor>
void describe(Visitor& v, HockettSherbyHardening& s) {
  v.field("sigma0", s.sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
  v.field("sigma_inf", s.sigmaInf, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at saturation.");
  v.field("rate", s.rate, {.required = true, .above = 0}, "Rate of saturation.");
  // The gamma function of its inverse overflows below 0.006.
  v.field("exponent", s.exponent, {.required = true, .atLeast = 0.01, .atMost = 1},
          "Exponent of the plastic strain times the rate.");
}

}  // namespace burnish::inline material
