#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace burnish::inline core {

/// Keeps other processes from a directory that all of them lock. The system gives it back when the process
/// ends, however it ends.
class DirectoryLock {
 public:
  enum class Children {
    LetGo,  ///< the lock ends with this process
    Keep    ///< processes that this one starts keep the lock as long as they live
  };

  /// Makes the directory if need be; one that was made and has nothing in it goes with the lock. Throws `Error`
  /// if it cannot be made, and with the message `taken` if another process has the lock.
  DirectoryLock(const std::filesystem::path& directory, Children children, const std::string& taken);
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;
  ~DirectoryLock();

  /// False on file systems that have no locks: nothing keeps other processes away.
  bool protects() const { return protects_; }

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
  int descriptor_;
  bool protects_ = true;
};

}  // namespace burnish::inline core
