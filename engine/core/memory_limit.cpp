#include "engine/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "engine/core/error.h"

namespace burnish {
namespace {

std::uint64_t limit() {
  struct ::rlimit found = {};
  if (::getrlimit(RLIMIT_AS, &found) != 0 || found.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<std::uint64_t>::max();
  return found.rlim_cur;
}

std::uint64_t used() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

bool memoryIsLimited() {
  return limit() != std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t freeMemory() {
  if (!memoryIsLimited()) return limit();
  return limit() - std::min(limit(), used());
}

void requireMemory(std::uint64_t bytes, const char* purpose) {
  if (freeMemory() >= bytes) return;
  throw Error(
      fmt::format("{} takes some {} MB more than the {} MB that the program may use (ulimit -v); raise the "
                  "limit to {} MB or more",
                  purpose, (bytes - freeMemory()) / kMegabyte + 1, limit() / kMegabyte,
                  (used() + bytes) / kMegabyte + 1));
}

}  // namespace burnish
