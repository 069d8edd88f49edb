#include "cli/output_lock.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "engine/core/error.h"

namespace burnish {
namespace {

DirectoryLock locked(const std::filesystem::path& directory) {
  try {
    return {directory, DirectoryLock::Children::Keep,
            fmt::format("another burnish is at work in {}; wait for its end", directory.string())};
  } catch (const Error& error) {
    throw Error(fmt::format("-o: {}", error.what()));
  }
}

}  // namespace

DirectoryLock lockOutput(const std::filesystem::path& directory) {
  DirectoryLock lock = locked(directory);
  if (!lock.protects())
    printError(
        "warning: the file system of {} has no locks; see to it that no other burnish writes there meanwhile\n",
        directory.string());
  return lock;
}

}  // namespace burnish
