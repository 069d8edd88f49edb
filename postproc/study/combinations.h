#pragma once
#include <map>
#include <string>
#include <vector>

#include "postproc/study/study.h"

namespace burnish {

/// What braces stand for in every combination of the values of the parameters, the last parameter changing
/// fastest: the value under "name", its label (the value itself without labels) under "name.label". One empty
/// combination without parameters.
std::vector<std::map<std::string, std::string>> combinations(const std::vector<ParameterSpec>& vary);

}  // namespace burnish
