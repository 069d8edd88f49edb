#pragma once
#include "engine/scene/scene.h"
#include "engine/schema/leaf.h"

namespace burnish {

template <>
struct EnumNames<NeoHookeanSpec::Volumetric> {
  static constexpr std::array values{std::pair{"log", NeoHookeanSpec::Volumetric::Log},
                                     std::pair{"simo", NeoHookeanSpec::Volumetric::Simo}};
};

template <>
struct EnumNames<J2Spec::Elastic> {
  static constexpr std::array values{std::pair{"neo-hookean", J2Spec::Elastic::NeoHookean},
                                     std::pair{"hencky", J2Spec::Elastic::Hencky}};
};

/// Young's modulus and Poisson's ratio, the same for every law.
template <class Visitor>
void describeElasticConstants(Visitor& v, double& E, double& nu) {
  v.field("E", E, {.required = true, .above = 0, .unit = "stress"}, "Young's modulus.");
  v.field("nu", nu, {.required = true, .above = -1, .below = 0.5}, "Poisson's ratio.");
}

/// The stress at which flow begins, the same for every closed-form hardening law.
template <class Visitor>
void describeFirstYield(Visitor& v, double& sigma0) {
  v.field("sigma0", sigma0, {.required = true, .above = 0, .unit = "stress"}, "Yield stress at the start.");
}

template <class Visitor>
void describe(Visitor& v, NeoHookeanSpec& s) {
  describeElasticConstants(v, s.E, s.nu);
  v.field("volumetric", s.volumetric, {},
          "Volumetric energy U: log is lambda/2 (ln J)^2, simo is lambda/4 (J^2 - 1 - 2 ln J).");
}

template <class Visitor>
void describe(Visitor& v, VoceSpec& s) {
  describeFirstYield(v, s.sigma0);
  v.field("sigma_inf", s.sigmaInf, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at saturation.");
  v.field("beta", s.beta, {.required = true, .atLeast = 0}, "Rate of saturation.");
}

template <class Visitor>
void describe(Visitor& v, TwoTermVoceSpec& s) {
  describeFirstYield(v, s.sigma0);
  v.field("q1", s.q1, {.required = true, .atLeast = 0, .unit = "stress"}, "Hardening of the first term.");
  v.field("beta1", s.beta1, {.required = true, .atLeast = 0}, "Rate of saturation of the first term.");
  v.field("q2", s.q2, {.required = true, .atLeast = 0, .unit = "stress"}, "Hardening of the second term.");
  v.field("beta2", s.beta2, {.required = true, .atLeast = 0}, "Rate of saturation of the second term.");
}

template <class Visitor>
void describe(Visitor& v, LinearHardeningSpec& s) {
  describeFirstYield(v, s.sigma0);
  v.field("modulus", s.modulus, {.required = true, .atLeast = 0, .unit = "stress"},
          "Increase of the yield stress per unit of plastic strain.");
}

template <class Visitor>
void describe(Visitor& v, VoceLinearSpec& s) {
  describeFirstYield(v, s.sigma0);
  v.field("sigma_inf", s.sigmaInf, {.required = true, .above = 0, .unit = "stress"},
          "Yield stress at saturation of the exponential part.");
  v.field("beta", s.beta, {.required = true, .atLeast = 0}, "Rate of saturation.");
  v.field("modulus", s.modulus, {.required = true, .atLeast = 0, .unit = "stress"},
          "Slope of the linear part.");
}

template <class Visitor>
void describe(Visitor& v, TableHardeningSpec& s) {
  v.field("ep", s.ep, {.required = true, .atLeast = 0, .increasing = true, .minEntries = 1},
          "Equivalent plastic strains; the first is 0.");
  v.field("stress", s.stress, {.required = true, .above = 0, .minEntries = 1, .unit = "stress"},
          "Yield stress at each of them; linear in between and constant beyond the last.");
}

template <class Visitor>
void describe(Visitor& v, FormulaHardeningSpec& s) {
  v.field("formula", s.formula, {.required = true, .unit = "stress"},
          "Yield stress as a formula in ep, such as \"80 + 90 * (1 - exp(-18 * ep))\".");
}

template <class Visitor>
void describe(Visitor& v, HardeningSpec& s) {
  v.alternatives("law", s,
                 {{{"voce", "sigma0 + (sigma_inf - sigma0) (1 - exp(-beta ep))."},
                   {"two-term-voce", "sigma0 + q1 (1 - exp(-beta1 ep)) + q2 (1 - exp(-beta2 ep))."},
                   {"linear", "sigma0 + modulus ep; modulus 0 is perfect plasticity."},
                   {"voce-linear", "sigma0 + (sigma_inf - sigma0) (1 - exp(-beta ep)) + modulus ep."},
                   {"table", "Piecewise linear."},
                   {"formula", "A formula in the equivalent plastic strain."}}},
                 "How the yield stress grows with the equivalent plastic strain ep.");
}

template <class Visitor>
void describe(Visitor& v, J2Spec& s) {
  describeElasticConstants(v, s.E, s.nu);
  v.field("elastic", s.elastic, {}, "Elastic law in principal stretches.");
  v.field("hardening", s.hardening, {.required = true}, "Yield stress.");
}

template <class Visitor>
void describe(Visitor& v, MaterialSpec& s) {
  v.alternatives(
      "law", s,
      {{{"neo-hookean", "Compressible neo-Hookean elasticity."},
        {"j2", "Finite-strain plasticity with the von Mises yield condition and isotropic hardening."}}},
      "Kind of material.");
}

}  // namespace burnish
