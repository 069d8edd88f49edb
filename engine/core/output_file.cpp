#include "engine/core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/core/error.h"

namespace burnish::inline core {
namespace {

/// The name that a file has or, of one that takes its name when it is complete, will have.
std::filesystem::path finalName(const std::filesystem::path& path) {
  return path.extension() == kPartial ? path.parent_path() / path.stem() : path;
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
  const std::string reason = errno == ELOOP
                                 ? "it is a symbolic link, and what that points to is not ours to change"
                                 : std::generic_category().message(errno);
  throw Error(fmt::format("cannot {} {}: {}", action, finalName(path).string(), reason));
}

/// An empty file of that name, opened; negative if there can be none.
int create(const std::filesystem::path& path) {
  std::error_code status;
  if (std::filesystem::is_symlink(path, status)) std::filesystem::remove(path, status);
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), descriptor_(create(path_)) {
  if (descriptor_ < 0) fail(path_, "write");
}

OutputFile::OutputFile(std::filesystem::path path, std::uint64_t size)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC)),
      size_(size) {
  if (descriptor_ < 0) fail(path_, "go on with");
  struct ::stat status = {};
  const bool isLong =
      ::fstat(descriptor_, &status) == 0 && static_cast<std::uint64_t>(status.st_size) >= size;
  const auto end = static_cast<off_t>(size);
  if (isLong && ::ftruncate(descriptor_, end) == 0 && ::lseek(descriptor_, end, SEEK_SET) == end) return;
  ::close(descriptor_);
  if (isLong) fail(path_, "go on with");
  throw Error(fmt::format(
      "{} is shorter than the {} bytes that the run had written; bring it back, or compute the scene again",
      path_.string(), size));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "write");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    size_ += static_cast<std::uint64_t>(written);
  }
}

void OutputFile::sync() {
  if (::fsync(descriptor_) != 0) fail(path_, "write");
  struct ::stat status = {};
  if (::fstat(descriptor_, &status) == 0 && status.st_nlink == 0)
    throw Error(fmt::format("{} was removed while it was being written", finalName(path_).string()));
}

void OutputFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "write");
}

}  // namespace burnish::inline core
