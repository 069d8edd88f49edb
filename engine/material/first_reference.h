#pragma once
#include <variant>

#include "engine/material/material.h"

namespace burnish::inline material {

/// Whether the history of the material belongs to the first undeformed state, so that it cannot be referred to another
/// one: plastic strain that is taken off the logarithm of the whole deformation.
inline bool belongsToFirstReference(const MaterialParameters& material) {
  return std::visit(
      [](const auto& parameters) {
        if constexpr (requires { parameters.frame; })
          return parameters.frame == StrainFrame::Additive;
        else
          return false;
      },
      material);
}

}  // namespace burnish::inline material
