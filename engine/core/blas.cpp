#include "engine/core/blas.h"

#include <cblas.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/memory_limit.h"

/// Buffers for one thread each, which OpenBLAS keeps when they are given back.
extern "C" {
void* blas_memory_alloc(int);
void blas_memory_free(void*);
}

/// Of LAPACK.
extern "C" void dpbtrf_(const char* triangle, const blasint* n, const blasint* width, double* band,
                        const blasint* stride, blasint* problem, std::size_t triangleLength);

namespace burnish {
namespace {

blasint size(Eigen::Index n) {
  return static_cast<blasint>(n);
}

/// Kernels for the instruction sets of this processor, or null if the slowest ones are right.
const char* fastestKernels() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
  return nullptr;
}

}  // namespace

void useFastestBlasKernels(char** argv) {
  constexpr const char* choice = "OPENBLAS_CORETYPE";
  const std::string chosen = openblas_get_corename();
  if (chosen != "Prescott" && chosen != "Core2" && chosen != "Nehalem") return;
  const char* kernels = fastestKernels();
  if (kernels == nullptr || std::getenv(choice) != nullptr) return;
  ::setenv(choice, kernels, 0);
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);  // as pinLibrariesToOneThread() would have it a moment later
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown)
    ::execv(program.c_str(), argv);  // comes back only if it fails, and then all goes on as it was
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
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, size(A.rows()), size(B.rows()), size(A.cols()), 1.0,
              A.data(), size(A.outerStride()), B.data(), size(B.outerStride()), 0.0, C.data(),
              size(C.outerStride()));
}

bool factoriseBand(Eigen::MatrixXd& band) {
  const blasint n = size(band.cols()), width = size(band.rows() - 1), stride = size(band.rows());
  blasint problem = 0;
  dpbtrf_("L", &n, &width, band.data(), &stride, &problem, 1);
  return problem == 0;
}

void solveBand(const Eigen::MatrixXd& factor, Eigen::Ref<Eigen::VectorXd> x) {
  const Eigen::Index zeros = std::find_if(x.begin(), x.end(), [](double v) { return v != 0.0; }) - x.begin();
  if (zeros == x.size()) return;
  cblas_dtbsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, size(x.size() - zeros),
              size(factor.rows() - 1), factor.col(zeros).data(), size(factor.rows()), x.data() + zeros, 1);
}

void solveBandTransposed(const Eigen::MatrixXd& factor, Eigen::Ref<Eigen::VectorXd> x) {
  cblas_dtbsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, size(x.size()), size(factor.rows() - 1),
              factor.data(), size(factor.rows()), x.data(), 1);
}

}  // namespace burnish
