#include "cli/fastest_program.h"

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "engine/core/blas.h"

namespace burnish {

std::string programForProcessor() {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi2"))
    return "";
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto program = self.parent_path() / BURNISH_NEWER_PROGRAM;
  return !unknown && ::access(program.c_str(), X_OK) == 0 ? program.string() : "";
}

void startFastest(char** argv) {
  if (const std::string program = programForProcessor(); !program.empty()) ::execv(program.c_str(), argv);
  useFastestBlasKernels();
}

}  // namespace burnish
