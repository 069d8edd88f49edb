#pragma once
#include <string>

#include "engine/scene/scene.h"

namespace burnish {

/// The scene as YAML with every default spelled out; reading it gives the same scene. Optional values and
/// empty lists that are left out stay out.
std::string writeScene(const Scene& scene);

}  // namespace burnish
