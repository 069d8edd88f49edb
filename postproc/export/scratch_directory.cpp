#include "postproc/export/scratch_directory.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "engine/core/error.h"

namespace burnish {

ScratchDirectory::ScratchDirectory() {
  std::error_code problem;
  const std::filesystem::path place = std::filesystem::temp_directory_path(problem);
  std::string name = (place / "burnish_XXXXXX").string();
  if (!problem && mkdtemp(name.data()) == nullptr) problem.assign(errno, std::generic_category());
  if (problem) {
    const char* chosen = std::getenv("TMPDIR");
    throw Error(
        fmt::format("cannot make a directory for temporary files in {}: {}; let TMPDIR name one in which "
                    "there can be files",
                    place.empty() && chosen != nullptr ? chosen : place.string(), problem.message()));
  }
  path_ = name;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace burnish
