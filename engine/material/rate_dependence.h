#pragma once
#include <variant>

#include "engine/material/material.h"

namespace burnish::inline material {

/// Whether the stress of the material depends on the time that a step takes: the law has a `rate`, and the scene gives
/// it.
inline bool dependsOnRate(const MaterialParameters& material) {
  return std::visit(
      [](const auto& parameters) {
        if constexpr (requires { parameters.rate.has_value(); })
          return parameters.rate.has_value();
        else
          return false;
      },
      material);
}

}  // namespace burnish::inline material
