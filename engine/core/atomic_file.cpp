#include "engine/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "engine/core/error.h"
#include "engine/core/output_file.h"

namespace burnish::inline core {
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

/// Calls write(temporary name), after which that file is complete and synced, and renames it.
template <class Write>
void replaceFile(const fs::path& path, const Write& write) {
  const fs::path partial = partialName(path);
  try {
    write(partial);
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

void finish(OutputFile& file) {
  file.sync();
  file.close();
}

}  // namespace

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  replaceFile(path, [&](const fs::path& partial) {
    OutputFile file(partial);
    file.write(bytes);
    finish(file);
  });
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path& partial)>& write) {
  replaceFile(path, [&](const fs::path& partial) {
    OutputFile(partial).close();  // throws with the reason if there can be no such file
    write(partial);
    OutputFile file(partial, fs::file_size(partial));
    finish(file);
  });
}

fs::path partialName(const fs::path& path) {
  fs::path partial = path;
  partial += kPartial;
  return partial;
}

}  // namespace burnish::inline core
