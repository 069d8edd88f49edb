#pragma once
#include <filesystem>
#include <optional>

#include "postproc/export/scratch_directory.h"

namespace burnish {

/// Where a command writes a file: the name that was given or, for -, a file that is printed on standard output.
class OutputTarget {
 public:
  /// ending: that of a file that is printed. Throws `Error` if standard output is a terminal.
  OutputTarget(std::filesystem::path name, const char* ending);

  /// The file to be written.
  const std::filesystem::path& file() const { return file_; }

  /// To be called when it is written.
  void finish() const;

 private:
  std::optional<ScratchDirectory> scratch_;
  std::filesystem::path file_;
};

/// Whether -o - was given.
bool isStandardOutput(const std::filesystem::path& name);

}  // namespace burnish
