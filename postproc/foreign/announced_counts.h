#pragma once
#include <filesystem>
#include <vector>

#include "postproc/foreign/foreign_source.h"

namespace burnish {

/// Files that say how many points and cells they hold (STL, PLY, legacy VTK) hold them: their readers stop at the end of
/// a file that was cut off, without a word. Throws `Error` with both numbers.
void requireAnnounced(const std::filesystem::path& file, const std::vector<ForeignBlock>& blocks);

/// A file of AVS UCD in letters has a line for each point, cell and set of values that it announces, with as many words as these take:
/// its reader makes up what is missing. Throws `Error` where it has not, or is no such file.
void requireAvs(const std::filesystem::path& file);

/// A file of Tecplot in letters has zones: of one without any, its reader says nothing. Throws `Error`.
void requireTecplot(const std::filesystem::path& file);

}  // namespace burnish
