#pragma once
#include <string>
#include <variant>

#include "engine/material/formula_hardening.h"
#include "engine/material/hockett_sherby_hardening.h"
#include "engine/material/law_list.h"
#include "engine/material/linear_hardening.h"
#include "engine/material/ludwik_hardening.h"
#include "engine/material/swift_hardening.h"
#include "engine/material/table_hardening.h"
#include "engine/material/two_term_voce_hardening.h"
#include "engine/material/voce_hardening.h"
#include "engine/material/voce_linear_hardening.h"

/// Hardening laws: the yield stress σ_y as a function of the equivalent plastic strain e >= 0. Every law has
///   kind         its name in scenes, and a sentence,
///   sigma_y(e)   the yield stress,
///   slope(e)     its derivative (from the right where a law has a corner),
///   work(e)      H(e) = ∫_0^e σ_y,
/// a `describe` for what it is made from and, where the keys do not say all, a `check` of that.
namespace burnish::inline schema {
class Problems;
}  // namespace burnish::inline schema

namespace burnish::inline material {

/// All hardening laws, one line each.
using HardeningLaws = LawList<  //
    VoceHardening,              //
    TwoTermVoceHardening,       //
    LinearHardening,            //
    VoceLinearHardening,        //
    LudwikHardening,            //
    SwiftHardening,             //
    HockettSherbyHardening,     //
    TableHardening,             //
    FormulaHardening>;

using Hardening = HardeningLaws::Any;
using HardeningParameters = HardeningLaws::Parameters;

template <class Visitor>
void describe(Visitor& v, HardeningParameters& s) {
  HardeningLaws::describe(v, s, "How the yield stress grows with the equivalent plastic strain ep.");
}

/// Reports what keeps the law from being made. key: under which it stands.
inline void checkHardening(const HardeningParameters& hardening, const Problems& problems,
                           const std::string& key) {
  std::visit(
      [&](const auto& parameters) {
        if constexpr (requires { check(parameters, problems, key); }) check(parameters, problems, key);
      },
      hardening);
}

}  // namespace burnish::inline material
