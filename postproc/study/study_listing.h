#pragma once
#include <string>

#include "engine/schema/declaration.h"

namespace burnish {

/// Every key of a study.
Declarations studyDeclarations();

/// Every key of a study with its type, range, unit, default and meaning, as a nested Markdown list.
std::string describeStudy();

}  // namespace burnish
