#include "postproc/compare/baseline_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "engine/core/error.h"

namespace burnish {

namespace fs = std::filesystem;

void requireInBaselines(const std::string& name, const fs::path& baseline, const fs::path& file) {
  fs::path root = baseline.lexically_normal();
  for ([[maybe_unused]] const fs::path& part : fs::path(name)) root = root.parent_path();
  if (root.empty()) root = ".";
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(root, unknown);
  const fs::path place = fs::weakly_canonical(file.parent_path().empty() ? "." : file.parent_path(), unknown);
  if (std::mismatch(whole.begin(), whole.end(), place.begin(), place.end()).first == whole.end()) return;
  throw Error(fmt::format(
      "{}: found a symbolic link on its way, which leads to {}; a new baseline is only written below {}: put a "
      "directory in the place of the link",
      file.string(), place.string(), root.string()));
}

}  // namespace burnish
