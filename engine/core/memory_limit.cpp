#include "engine/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "engine/core/error.h"

namespace burnish::inline core {
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

struct Limits {
  Limit space, data;
};

Limits presentLimits() {
  Limits found{{bytesOf(RLIMIT_AS), 0, "ulimit -v"}, {bytesOf(RLIMIT_DATA), 0, "ulimit -d"}};
  if (found.space.bytes == kUnlimited && found.data.bytes == kUnlimited) return found;
  std::array<std::uint64_t, 6> pages{};  // size, resident, shared, text, unused, data
  std::ifstream statm("/proc/self/statm");
  for (std::uint64_t& number : pages) statm >> number;
  const auto pageSize = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  found.space.used = pages[0] * pageSize;
  found.data.used = pages[5] * pageSize;
  return found;
}

void require(std::uint64_t bytes, const Limit& limit, const char* purpose) {
  if (limit.free() >= bytes) return;
  throw Error(
      fmt::format("{} takes some {} MB more than the {} MB that the program may use ({}); raise the limit to "
                  "{} MB or more",
                  purpose, (bytes - limit.free()) / kMegabyte + 1, limit.bytes / kMegabyte, limit.command,
                  (limit.used + bytes) / kMegabyte + 1));
}

}  // namespace

bool memoryIsLimited() {
  const auto [space, data] = presentLimits();
  return space.bytes != kUnlimited || data.bytes != kUnlimited;
}

std::uint64_t freeMemory() {
  const auto [space, data] = presentLimits();
  return std::min(space.free(), data.free());
}

void requireMemory(std::uint64_t bytes, const char* purpose, std::uint64_t mapped) {
  const auto [space, data] = presentLimits();
  require(bytes, data, purpose);
  require(bytes + mapped, space, purpose);
}

}  // namespace burnish::inline core
