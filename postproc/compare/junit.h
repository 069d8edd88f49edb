#pragma once
#include <string>
#include <vector>

#include "postproc/compare/compared_case.h"

namespace burnish {

/// JUnit XML with one suite, which CI services show as a list of tests.
std::string junitText(const std::string& suite, const std::vector<ComparedCase>& cases);

}  // namespace burnish
