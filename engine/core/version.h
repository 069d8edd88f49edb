#pragma once
#include <string>

namespace burnish {

/// "0.1.0".
std::string version();

/// What computed a result: "burnish 0.1.0 (engine 1a2b3c4d)", with a digest of the engine's sources. Results
/// of equal scenes and equal names are equal.
std::string programName();

}  // namespace burnish
