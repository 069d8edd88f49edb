#pragma once
#include <filesystem>

#include "engine/core/directory_lock.h"

namespace burnish {

/// Keeps the output directory of a command, which is made if need be, to this process and those that it
/// starts; warns where the file system has no locks. Throws `Error` if another burnish has it or it cannot be
/// made.
DirectoryLock lockOutput(const std::filesystem::path& directory);

}  // namespace burnish
