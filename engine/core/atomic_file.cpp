#include "engine/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "engine/core/error.h"
#include "engine/core/output_file.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// Makes a rename durable. File systems that cannot sync a directory need no such call, so its answer is not
/// checked.
void syncDirectory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path partial = partialName(path);
  try {
    OutputFile file(partial);
    file.write(bytes);
    file.sync();
    file.close();
    fs::rename(partial, path);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw Error(fmt::format("cannot write {}: {}", path.string(), error.code().message()));
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
  syncDirectory(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

fs::path partialName(const fs::path& path) {
  fs::path partial = path;
  partial += ".partial";
  return partial;
}

}  // namespace burnish
