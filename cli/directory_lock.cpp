#include "cli/directory_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/core/error.h"

namespace burnish {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  std::error_code status;
  std::filesystem::create_directories(directory, status);
  if (status)
    throw Error(fmt::format("-o: cannot create the directory {}: {}", directory.string(), status.message()));
  // Without O_CLOEXEC: children that outlive this process keep the lock as long as they write.
  descriptor_ = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor_ < 0)
    throw Error(fmt::format("-o: cannot open {}: {}", directory.string(), std::strerror(errno)));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(descriptor_);
  throw Error(fmt::format("-o: another burnish is at work in {}; wait for its end", directory.string()));
}

DirectoryLock::~DirectoryLock() {
  ::close(descriptor_);
}

}  // namespace burnish
