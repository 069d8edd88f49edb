#pragma once
#include <algorithm>

#include "engine/scene/scene.h"

namespace burnish::inline analysis {

/// When the force of a support or a tool that has let go is gone.
inline double releaseEnd(const Scene& scene, const auto& spec) {
  return spec.releasedBy.value_or(scene.steps.back().until);
}

/// Whether the force of a support or a tool that has let go is on its way to zero at time t.
inline bool isReleasing(const Scene& scene, double t) {
  constexpr double kRounding = 1e-9;
  const auto fades = [&](const auto& spec) {
    const double now = t * (1.0 + kRounding);
    return spec.until && *spec.until <= now && now < releaseEnd(scene, spec);
  };
  return std::ranges::any_of(scene.supports, fades) || std::ranges::any_of(scene.tools, fades);
}

}  // namespace burnish::inline analysis
