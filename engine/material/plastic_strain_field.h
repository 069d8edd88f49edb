#pragma once
#include "engine/material/state_field.h"

namespace burnish::inline material {

/// The field of a state's `e_p`, the same for every law that flows.
template <class State>
StateField<State> plasticStrainField() {
  return {{.name = "plastic_strain",
           .components = {},
           .unit = "",
           .words = "Equivalent plastic strain",
           .symbol = "ε̄^p",
           .isNonNegative = true},
          [](const State& state, std::span<double> values) { values[0] = state.e_p; }};
}

}  // namespace burnish::inline material
