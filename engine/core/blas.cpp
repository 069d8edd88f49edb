#include "engine/core/blas.h"

#include <cblas.h>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/core/memory_limit.h"

/// Buffers for one thread each, which OpenBLAS keeps when they are given back.
extern "C" {
void* blas_memory_alloc(int);
void blas_memory_free(void*);
}

namespace burnish {
namespace {

/// Kernels for the instruction sets of this processor, or null if the slowest ones are right.
const char* fastestKernels() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
  return nullptr;
}

constexpr const char* kKernelsChoice = "OPENBLAS_CORETYPE";

/// Null for none.
const char* kernelsToAskFor() {
  const std::string chosen = openblas_get_corename();
  if (chosen != "Prescott" && chosen != "Core2" && chosen != "Nehalem") return nullptr;
  return std::getenv(kKernelsChoice) == nullptr ? fastestKernels() : nullptr;
}

}  // namespace

void useFastestBlasKernels(char** argv) {
  const char* kernels = kernelsToAskFor();
  if (kernels == nullptr) return;
  ::setenv(kKernelsChoice, kernels, 0);
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);  // as pinLibrariesToOneThread() would have it a moment later
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown)
    ::execv(program.c_str(), argv);  // comes back only if it fails, and then all goes on as it was
}

std::string_view blasKernelsToAskFor() {
  const char* kernels = kernelsToAskFor();
  return kernels != nullptr ? kernels : std::string_view();
}

std::string blasName() {
  const char* kernels = kernelsToAskFor();
  const std::string config = openblas_get_config();  // OpenBLAS 0.3.21 DYNAMIC_ARCH ...
  return fmt::format("{}, kernels {}", config.substr(0, config.find(' ', config.find(' ') + 1)),
                     kernels != nullptr ? kernels : openblas_get_corename());
}

void pinLibrariesToOneThread() {
  openblas_set_num_threads(1);
  omp_set_max_active_levels(0);  // CHOLMOD asks for threads of its own, whatever their default number is
}

int threadsWithMemory(int wanted) {
  if (!memoryIsLimited()) return wanted;
  constexpr std::uint64_t perThread = 144 * kMegabyte;  // OpenBLAS's buffer and the stack
  constexpr std::uint64_t rest = 48 * kMegabyte;        // for a small problem
  requireMemory(perThread + rest, "computing");
  const auto fitting = static_cast<int>((freeMemory() - rest) / perThread);
  std::vector<void*> buffers(static_cast<std::size_t>(std::min(wanted, fitting)));
  for (void*& buffer : buffers) buffer = blas_memory_alloc(0);
  for (void* buffer : buffers) blas_memory_free(buffer);
  return static_cast<int>(buffers.size());
}

void multiplyTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C) {
  C.resize(A.rows(), B.rows());
  multiplyTransposedInto(A, B, C);
}

void multiplyTransposedInto(const Eigen::Ref<const Eigen::MatrixXd>& A,
                            const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C) {
  assert(A.cols() == B.cols() && C.rows() == A.rows() && C.cols() == B.rows());
  const auto size = [](Eigen::Index n) { return static_cast<blasint>(n); };
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, size(A.rows()), size(B.rows()), size(A.cols()), 1.0,
              A.data(), size(A.outerStride()), B.data(), size(B.outerStride()), 0.0, C.data(),
              size(C.outerStride()));
}

}  // namespace burnish
