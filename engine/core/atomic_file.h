#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace burnish::inline core {

/// Writes a file that exists under its name only when it is complete, whatever happens meanwhile: the bytes
/// go to `partialName(path)`, are synced, and the file is renamed. Throws `Error`; then no partial file stays
/// behind and an earlier file of that name is untouched.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// As above, for a file that a library makes: `write` is called with the temporary name, under which an empty
/// file stands, and throws if it fails.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& partial)>& write);

/// The temporary name of a file that is being written.
std::filesystem::path partialName(const std::filesystem::path& path);

}  // namespace burnish::inline core
