#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace burnish::fuzz {

/// A file in memory under a name, for readers that want a path.
class TemporaryFile {
 public:
  /// extension: with its dot; some readers look at it.
  explicit TemporaryFile(const std::string& extension)
      : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)),
        path_(std::filesystem::temp_directory_path() /
              ("burnish_fuzz_" + std::to_string(::getpid()) + extension)) {
    std::filesystem::remove(path_);
    std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(descriptor_), path_);
  }
  ~TemporaryFile() {
    ::close(descriptor_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Replaces the contents.
  const std::filesystem::path& hold(const std::uint8_t* data, std::size_t size) {
    if (::ftruncate(descriptor_, 0) != 0 ||
        ::pwrite(descriptor_, data, size, 0) != static_cast<ssize_t>(size))
      throw std::runtime_error("cannot write a file in memory");
    return path_;
  }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace burnish::fuzz
