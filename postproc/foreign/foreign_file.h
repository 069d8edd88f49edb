#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "postproc/foreign/foreign_source.h"

namespace burnish {

/// A file of another program, read by VTK's readers in a process of their own: some of them end it on a damaged
/// file, or take memory and time without an end.
class ForeignFile {
 public:
  /// Starts that process; do so before the first picture, whose threads it would not have. Throws `Error` naming
  /// the file if it is not there, none of its ending, or damaged.
  explicit ForeignFile(const std::filesystem::path& file);
  ~ForeignFile();
  ForeignFile(const ForeignFile&) = delete;
  ForeignFile& operator=(const ForeignFile&) = delete;

  const std::filesystem::path& file() const;

  /// Ascending; empty for one instant without a time.
  const std::vector<double>& times() const;

  /// What is there at an instant, 0 without times; sound as `isSound` has it, and not to be changed: the last one is
  /// kept. Throws `Error` as the constructor does, and `Interrupted`.
  std::vector<ForeignBlock> blocks(std::size_t instant) const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace burnish
