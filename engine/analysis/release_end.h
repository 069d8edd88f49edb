#pragma once
#include "engine/scene/scene.h"

namespace burnish {

/// When the force of a support or a tool that has let go is gone.
inline double releaseEnd(const Scene& scene, const auto& spec) {
  return spec.releasedBy.value_or(scene.steps.back().until);
}

}  // namespace burnish
