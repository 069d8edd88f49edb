#include <sys/auxv.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "engine/core/sanitized.h"

/// What has to be set before the libraries start, which read it then: the program starts itself again with it.
///
/// Where the address space or the data are limited (ulimit -v, -d): OpenBLAS starts threads when it is loaded, each with 136 MB, and
/// waits for ever for what it does not get.
///
/// Else for commands that compute or draw: memory in pages of 2 MB where the system has them for those who ask (glibc's
/// tunable; /sys/kernel/mm/transparent_hugepage/enabled), as the pages of 4 KB of a large system or picture take a fifth of its time to
/// get and to find.
namespace {

/// With its libraries the program has some 100 MB, with VTK among them 150, of which 2 to 4 are data; reading a result takes some more.
constexpr rlim_t kLeastSpace = BURNISH_LEAST_SPACE, kLeastData = 32;  // MB

#define BURNISH_TEXT(number) #number
#define BURNISH_TEXT_OF(macro) BURNISH_TEXT(macro)

/// Threads and arenas of libraries, each of which reserves room; results and pictures do not depend on them.
constexpr std::array kSavings{"OPENBLAS_NUM_THREADS=1", "MALLOC_ARENA_MAX=1", "LP_NUM_THREADS=1"};

constexpr const char* kLargePages = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";

/// Commands that compute or draw, to which it is worth the 25 ms that the second start takes.
constexpr std::array kWithMuchMemory{"run",    "render", "animate",   "sheet",      "plot",
                                     "probe",  "export", "report",    "compare",    "figures",
                                     "verify", "view",   "roughness", "indentation"};

bool isSet(const char* assignment, char** environment) {
  for (; *environment != nullptr; ++environment)
    if (std::strcmp(*environment, assignment) == 0) return true;
  return false;
}

/// Whether there is a variable of the name of an assignment.
bool hasNameOf(const char* variable, const char* assignment) {
  return std::strncmp(variable, assignment,
                      static_cast<std::size_t>(std::strchr(assignment, '=') - assignment) + 1) == 0;
}

/// Starts the program again with variables in place of those of the same names; comes back only if that fails.
template <std::size_t Count>
void startAgain(const std::array<const char*, Count>& assignments, char** argv, char** environment) {
  std::array<char*, 4096> variables{};
  std::size_t count = 0;
  for (const char* assignment : assignments) variables[count++] = const_cast<char*>(assignment);
  for (; *environment != nullptr; ++environment) {
    bool isReplaced = false;
    for (const char* assignment : assignments) isReplaced = isReplaced || hasNameOf(*environment, assignment);
    if (isReplaced) continue;
    if (count + 1 == variables.size()) return;
    variables[count++] = *environment;
  }
  std::array<char, 4096> program{};
  const ssize_t length = ::readlink("/proc/self/exe", program.data(), program.size() - 1);
  if (length > 0) ::execve(program.data(), argv, variables.data());
}

/// Whoever has set tunables has set them for a reason. The system does not hand them to programs with other rights than their
/// caller's, and one that was started by the dynamic loader's name cannot start itself.
void takeLargePages(char** argv, char** environment) {
  if (argv[0] == nullptr || argv[1] == nullptr || ::getauxval(AT_SECURE) != 0 || ::getauxval(AT_BASE) == 0)
    return;
  bool takesMuch = false;
  for (const char* command : kWithMuchMemory) takesMuch = takesMuch || std::strcmp(argv[1], command) == 0;
  if (!takesMuch) return;
  for (char** variable = environment; *variable != nullptr; ++variable)
    if (hasNameOf(*variable, kLargePages)) return;
  startAgain(std::array{kLargePages}, argv, environment);
}

/// Runs before the libraries are initialised, and so with system calls alone.
__attribute__((no_sanitize("address", "undefined"))) void beforeLibraries(int, char** argv,
                                                                          char** environment) {
  struct ::rlimit space = {}, data = {};
  if (::getrlimit(RLIMIT_AS, &space) != 0 || ::getrlimit(RLIMIT_DATA, &data) != 0) return;
  if (space.rlim_cur == RLIM_INFINITY && data.rlim_cur == RLIM_INFINITY) {
    if (!burnish::kIsSanitized)
      takeLargePages(argv, environment);  // sanitizers cannot watch what comes before them
    return;
  }
  if (space.rlim_cur >> 20U < kLeastSpace || data.rlim_cur >> 20U < kLeastData) {
    constexpr char text[] =
        "burnish: the memory that the program may use is below what it takes to start, " BURNISH_TEXT_OF(
            BURNISH_LEAST_SPACE) " MB (ulimit -v) with 32 MB of data (ulimit -d); raise the limit\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, sizeof(text) - 1);
    ::_exit(2);
  }
  for (const char* assignment : kSavings)
    if (!isSet(assignment, environment)) return startAgain(kSavings, argv, environment);
}

__attribute__((section(".preinit_array"), used)) void (*const entry)(int, char**, char**) = beforeLibraries;

}  // namespace
