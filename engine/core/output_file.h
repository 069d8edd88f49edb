#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace burnish::inline core {

/// How the name of a file ends that is not complete.
inline constexpr const char* kPartial = ".partial";

/// A file opened for writing. Every member throws `Error` naming the file, as it is to be called in the end, and the
/// system's reason, a full disk included.
class OutputFile {
 public:
  /// Creates or empties the file. A symbolic link of that name is replaced, never written through.
  explicit OutputFile(std::filesystem::path path);

  /// Goes on behind the first `size` bytes of a file and drops what follows them. Throws if it is shorter, or
  /// a symbolic link.
  OutputFile(std::filesystem::path path, std::uint64_t size);

  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands all bytes to the system, or throws.
  void write(std::span<const std::byte> bytes);

  /// Returns when the contents are on the disk. Throws if the file was removed meanwhile.
  void sync();

  std::uint64_t size() const { return size_; }

  /// Closes the file; some file systems report a failed write only here. The destructor closes silently.
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace burnish::inline core
