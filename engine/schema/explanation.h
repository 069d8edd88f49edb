#pragma once
#include <string>

#include "engine/schema/declaration.h"

namespace burnish::inline schema {

/// What there is to say about a key such as `tools.motion.x` or `tools[0].radius`: type, range, unit, default
/// and meaning, and the keys below it; once for every alternative that has it. Throws `Error` with the
/// nearest keys if there is none.
std::string explainKey(const Declarations& keys, const std::string& key);

}  // namespace burnish::inline schema
