#pragma once
#include <string>

#include "engine/schema/declaration.h"

namespace burnish {

/// Every key of a scene.
Declarations sceneDeclarations();

/// Every key of a scene with its type, range, unit, default and meaning, as a nested Markdown list.
std::string describeScene();

}  // namespace burnish
