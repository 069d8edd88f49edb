#pragma once
#include <string>

namespace burnish {

/// Every key of a study with its type, range, unit, default and meaning, as a nested Markdown list.
std::string describeStudy();

}  // namespace burnish
