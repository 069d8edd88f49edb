#pragma once
#include <filesystem>

namespace burnish {

/// Keeps a directory, which is made if need be, to this process and those that it starts. Throws `Error` if
/// another one has it or it cannot be made.
class DirectoryLock {
 public:
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace burnish
