#pragma once
#include <filesystem>
#include <string>

namespace burnish::inline core {

/// What an STL file announces and does not hold, as one that was cut off: triangles, or its end. Empty for one that is whole.
std::string stlDamage(const std::filesystem::path& file);

}  // namespace burnish::inline core
