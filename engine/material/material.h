#pragma once
#include <variant>

#include "engine/material/j2_plasticity.h"
#include "engine/material/neo_hookean.h"

namespace burnish {

/// Any material law. Visit once outside a loop over quadrature points:
/// `std::visit([&](const auto& law) { for (…) law.template evaluate<Dim>(F, old, next, out); }, material)`.
using Material = std::variant<NeoHookean, J2Plasticity>;

inline double youngsModulus(const Material& material) {
  return std::visit([](const auto& law) { return law.youngsModulus(); }, material);
}

inline double shearModulus(const Material& material) {
  return std::visit([](const auto& law) { return law.shearModulus(); }, material);
}

}  // namespace burnish
