#pragma once
#include <variant>

#include "engine/material/formula_rate.h"
#include "engine/material/law_list.h"

/// How the stress beyond the yield stress depends on the rate of plastic strain. Every law has
///   kind   its name in scenes, and a sentence,
/// and a `describe` for what it is made from. The solution of the flow (`plastic_flow.h`) asks which one it is.
namespace burnish::inline material {

/// Norton's overstress: σ = σ_y(e) + K ė^{1/N}. Perzyna's ė = ((σ/σ_y,0 − 1))^N/η is K = σ_y,0 η^{1/N} with a yield
/// stress that stays.
struct NortonRate {
  static constexpr LawKind kind{"norton", "The stress exceeds the yield stress by K rate^(1/N)."};

  double K = 0.0;
  double N = 1.0;
};

template <class Visitor>
void describe(Visitor& v, NortonRate& s) {
  v.field("K", s.K, {.required = true, .above = 0, .unit = "stress"},
          "Overstress at a rate of one plastic strain per unit of time.");
  v.field("N", s.N, {.required = true, .atLeast = 1, .atMost = 500}, "Exponent; 1 is linear viscosity.");
}

/// Johnson and Cook: σ = σ_y(e) (1 + C ln(ė/ė_0)) where ė > ė_0, else σ_y.
struct JohnsonCookRate {
  static constexpr LawKind kind{"johnson-cook", "The yield stress times 1 + C ln(rate/rate0), above rate0."};

  double C = 0.0;
  double rate0 = 1.0;
};

template <class Visitor>
void describe(Visitor& v, JohnsonCookRate& s) {
  v.field("C", s.C, {.required = true, .atLeast = 0}, "Sensitivity to the rate.");
  v.field("rate0", s.rate0, {.required = true, .above = 0},
          "Rate up to which the yield stress stays as it is.");
}

using RateLaws = LawList<NortonRate, JohnsonCookRate, FormulaRate>;
using RateLaw = RateLaws::Any;
using RateParameters = RateLaws::Parameters;

template <class Visitor>
void describe(Visitor& v, RateParameters& s) {
  RateLaws::describe(v, s, "How the stress depends on the rate of plastic strain.");
}

}  // namespace burnish::inline material
