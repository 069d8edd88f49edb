#pragma once
#include <cstdint>

/// Where the address space or the data of the process are limited (ulimit -v, ulimit -d), libraries that get
/// no memory end the program or wait for ever; what they will need is therefore asked for before they are
/// called.
namespace burnish::inline core {

constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;

/// Whether there is a limit.
bool memoryIsLimited();

/// Bytes up to the closest limit; the largest number without one.
std::uint64_t freeMemory();

/// Throws `Error` unless as many bytes are free. purpose: what needs them, such as "drawing". mapped: bytes of libraries that will be
/// loaded for it, which take address space, but are no data.
void requireMemory(std::uint64_t bytes, const char* purpose, std::uint64_t mapped = 0);

}  // namespace burnish::inline core
