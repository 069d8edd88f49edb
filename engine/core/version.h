#pragma once
#include <string>

namespace burnish::inline core {

/// Such as "0.2.0".
std::string version();

/// What computed a result: "burnish 0.2.0 (engine 1a2b3c4d)", with a digest of what the compiler sees of the
/// engine. Results of equal scenes and equal names are equal.
std::string programName();

}  // namespace burnish::inline core
