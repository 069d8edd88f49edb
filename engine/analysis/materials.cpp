#include "engine/analysis/materials.h"

namespace burnish {
namespace {

Hardening harden(const VoceSpec& s) {
  return VoceHardening{s.sigma0, s.sigmaInf, s.beta};
}
Hardening harden(const TwoTermVoceSpec& s) {
  return TwoTermVoceHardening{s.sigma0, {s.q1, s.beta1}, {s.q2, s.beta2}};
}
Hardening harden(const LinearHardeningSpec& s) {
  return LinearHardening{s.sigma0, s.modulus};
}
Hardening harden(const VoceLinearSpec& s) {
  return VoceLinearHardening{{s.sigma0, s.sigmaInf, s.beta}, s.modulus};
}
Hardening harden(const TableHardeningSpec& s) {
  return TableHardening(s.ep, s.stress);
}
Hardening harden(const FormulaHardeningSpec& s) {
  return FormulaHardening(s.formula);
}

Material law(const NeoHookeanSpec& s) {
  return NeoHookean(s.E, s.nu,
                    s.volumetric == NeoHookeanSpec::Volumetric::Log ? NeoHookean::Volumetric::Log
                                                                    : NeoHookean::Volumetric::Simo);
}
Material law(const J2Spec& s) {
  const auto elastic = s.elastic == J2Spec::Elastic::NeoHookean ? ElasticLaw::NeoHookean : ElasticLaw::Hencky;
  return J2Plasticity(s.E, s.nu, elastic, std::visit([](const auto& h) { return harden(h); }, s.hardening));
}

}  // namespace

Material makeMaterial(const MaterialSpec& spec) {
  return std::visit([](const auto& s) { return law(s); }, spec);
}

}  // namespace burnish
