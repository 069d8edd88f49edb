#pragma once
#include <cstddef>
#include <filesystem>
#include <span>

namespace burnish {

/// A file opened for writing, emptied at first. Every member throws `Error` naming the file and the system's
/// reason, a full disk included.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands all bytes to the system, or throws.
  void write(std::span<const std::byte> bytes);

  /// Returns when the contents are on the disk.
  void sync();

  /// Closes the file; some file systems report a failed write only here. The destructor closes silently.
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace burnish
