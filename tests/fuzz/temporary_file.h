#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace burnish::fuzz {

/// A file in TMPDIR (fast in /dev/shm) for readers that want a path. It is a regular one: HDF5 opens no link
/// to a file in memory.
class TemporaryFile {
 public:
  /// extension: with its dot; some readers look at it.
  explicit TemporaryFile(const std::string& extension)
      : path_(std::filesystem::temp_directory_path() /
              ("burnish_fuzz_" + std::to_string(::getpid()) + extension)),
        descriptor_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {}
  ~TemporaryFile() {
    ::close(descriptor_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Replaces the contents.
  const std::filesystem::path& hold(const void* data, std::size_t size) {
    if (::ftruncate(descriptor_, 0) != 0 ||
        ::pwrite(descriptor_, data, size, 0) != static_cast<ssize_t>(size))
      throw std::runtime_error("cannot write " + path_.string());
    return path_;
  }

 private:
  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace burnish::fuzz
