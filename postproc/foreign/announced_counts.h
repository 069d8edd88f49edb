#pragma once
#include <filesystem>
#include <vector>

#include "postproc/foreign/foreign_source.h"

namespace burnish {

/// Files that say how many points and cells they hold (STL, PLY, legacy VTK) hold them: their readers stop at the end of
/// a file that was cut off, without a word. Throws `Error` with both numbers.
void requireAnnounced(const std::filesystem::path& file, const std::vector<ForeignBlock>& blocks);

}  // namespace burnish
