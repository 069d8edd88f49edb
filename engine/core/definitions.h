#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/formula.h"

namespace burnish::inline core {

/// What is wrong with a definition.
struct DefinitionProblem {
  std::size_t definition = 0;
  std::string text;
};

/// Definitions that cannot be understood, or that need a name which is neither one of the variables nor
/// defined before. Each is looked at once, however they depend on each other.
std::vector<DefinitionProblem> problemsOf(const std::vector<DefinitionSpec>& definitions,
                                          const std::vector<std::string>& variables = {"X", "Y", "Z", "t"});

}  // namespace burnish::inline core
