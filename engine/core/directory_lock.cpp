#include "engine/core/directory_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline core {
namespace {

/// The directory and those above it that do not exist, the innermost first.
std::vector<std::filesystem::path> missing(std::filesystem::path directory) {
  std::vector<std::filesystem::path> paths;
  std::error_code status;
  for (; !directory.empty() && !std::filesystem::exists(directory, status) && !status;
       directory = directory.parent_path())
    paths.push_back(directory);
  return paths;
}

int opened(const std::filesystem::path& directory, DirectoryLock::Children children) {
  std::error_code status;
  std::filesystem::create_directories(directory, status);
  if (status)
    throw Error(fmt::format("cannot create the directory {}: {}", directory.string(), status.message()));
  const int descriptor =
      ::open(directory.c_str(),
             O_RDONLY | O_DIRECTORY | (children == DirectoryLock::Children::LetGo ? O_CLOEXEC : 0));
  if (descriptor < 0)
    throw Error(fmt::format("cannot open the directory {}: {}", directory.string(),
                            std::generic_category().message(errno)));
  return descriptor;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, Children children,
                             const std::string& taken)
    : made_(missing(directory)), descriptor_(opened(directory, children)) {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  protects_ = false;
  if (errno != EWOULDBLOCK) return;  // a file system without locks
  ::close(descriptor_);
  throw Error(taken);
}

DirectoryLock::DirectoryLock(DirectoryLock&& other) noexcept
    : made_(std::exchange(other.made_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      protects_(other.protects_) {}

DirectoryLock::~DirectoryLock() {
  for (const std::filesystem::path& directory : made_)
    if (::rmdir(directory.c_str()) != 0) break;
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace burnish::inline core
