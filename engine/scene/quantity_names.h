#pragma once
#include <string>
#include <vector>

namespace burnish::inline scene {

/// Names of columns and definitions in a quantity, a formula in columns of a history. Throws `Error` for what
/// is no formula.
std::vector<std::string> namesInQuantity(const std::string& quantity);

}  // namespace burnish::inline scene
