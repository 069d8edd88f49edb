#include "engine/core/blas.h"

#include <cblas.h>
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/core/memory_limit.h"

extern "C" {
// Buffers for one thread each, which OpenBLAS keeps when they are given back.
void* blas_memory_alloc(int);
void blas_memory_free(void*);
// What it does when it is unloaded and loaded: forgets its kernels, and chooses them.
void gotoblas_dynamic_quit();
void gotoblas_dynamic_init();
// Ends its threads; that of a single thread (libopenblas0-serial) has no such function.
int blas_thread_shutdown_() __attribute__((weak));
}

namespace burnish::inline core {
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

void useFastestBlasKernels() {
  const char* kernels = kernelsToAskFor();
  if (kernels == nullptr) return;
  ::setenv(kKernelsChoice, kernels, 0);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
}

void stopBlasThreads() {
  openblas_set_num_threads(1);  // which would start them again
  if (blas_thread_shutdown_ != nullptr) blas_thread_shutdown_();
}

std::string blasName() {
  const char* kernels = kernelsToAskFor();
  const std::string config = openblas_get_config();  // OpenBLAS 0.3.21 DYNAMIC_ARCH ...
  return fmt::format("{}, kernels {}", config.substr(0, config.find(' ', config.find(' ') + 1)),
                     kernels != nullptr ? kernels : openblas_get_corename());
}

void pinLibrariesToOneThread() {
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);  // else it would start threads
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

}  // namespace burnish::inline core
