#pragma once
#include "engine/scene/scene.h"

namespace burnish {

/// When the force of a support that has let go is gone.
inline double releaseEnd(const Scene& scene, const SupportSpec& support) {
  return support.releasedBy.value_or(scene.steps.back().until);
}

}  // namespace burnish
