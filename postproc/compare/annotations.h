#pragma once
#include <string>
#include <vector>

#include "postproc/compare/compared_case.h"

/// Failures and errors where those who read a change see them.
namespace burnish {

/// Workflow commands, a line for each, which GitHub Actions shows as annotations when they are printed.
std::string githubAnnotations(const std::vector<ComparedCase>& cases);

/// A code quality report, which GitLab shows at a merge request: an issue for each. baseline: the file or directory that
/// they are said of.
std::string codeQualityText(const std::vector<ComparedCase>& cases, const std::string& baseline);

}  // namespace burnish
