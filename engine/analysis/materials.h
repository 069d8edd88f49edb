#pragma once
#include "engine/material/material.h"
#include "engine/scene/scene.h"

namespace burnish {

/// The material law of a scene. Throws `Error` for a hardening formula that cannot be evaluated.
Material makeMaterial(const MaterialSpec& spec);

}  // namespace burnish
