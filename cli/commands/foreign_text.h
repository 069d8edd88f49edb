#pragma once
#include <string>

#include "postproc/foreign/foreign_file.h"

namespace burnish {

/// What is in a file of another program: times, and of the last instant blocks, cells by type, bounds and fields
/// with their ranges.
std::string foreignText(const ForeignFile& file);

}  // namespace burnish
