#pragma once
#include <vector>

namespace burnish {

/// Groups of unknowns; every pair of unknowns inside a group may be coupled.
using CouplingGroups = std::vector<std::vector<int>>;

}  // namespace burnish
