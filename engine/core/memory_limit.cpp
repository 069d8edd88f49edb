#include "engine/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "engine/core/error.h"

namespace burnish {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// A limit of the process, and how much of it is taken.
struct Limit {
  std::uint64_t bytes = kUnlimited, used = 0;
  const char* command = "";

  std::uint64_t free() const { return bytes == kUnlimited ? bytes : bytes - std::min(bytes, used); }
};

std::uint64_t bytesOf(decltype(RLIMIT_AS) kind) {
  struct ::rlimit found = {};
  return ::getrlimit(kind, &found) != 0 || found.rlim_cur == RLIM_INFINITY ? kUnlimited : found.rlim_cur;
}

/// That of the address space or that of the data, whichever leaves less.
Limit closestLimit() {
  Limit space{bytesOf(RLIMIT_AS), 0, "ulimit -v"}, data{bytesOf(RLIMIT_DATA), 0, "ulimit -d"};
  if (space.bytes == kUnlimited && data.bytes == kUnlimited) return space;
  std::array<std::uint64_t, 6> pages{};  // size, resident, shared, text, unused, data
  std::ifstream statm("/proc/self/statm");
  for (std::uint64_t& number : pages) statm >> number;
  const auto pageSize = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  space.used = pages[0] * pageSize;
  data.used = pages[5] * pageSize;
  return data.free() < space.free() ? data : space;
}

}  // namespace

bool memoryIsLimited() {
  return closestLimit().bytes != kUnlimited;
}

std::uint64_t freeMemory() {
  return closestLimit().free();
}

void requireMemory(std::uint64_t bytes, const char* purpose) {
  const Limit limit = closestLimit();
  if (limit.free() >= bytes) return;
  throw Error(
      fmt::format("{} takes some {} MB more than the {} MB that the program may use ({}); raise the limit to "
                  "{} MB or more",
                  purpose, (bytes - limit.free()) / kMegabyte + 1, limit.bytes / kMegabyte, limit.command,
                  (limit.used + bytes) / kMegabyte + 1));
}

}  // namespace burnish
