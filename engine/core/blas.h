#pragma once
#include <Eigen/Dense>
#include <string>

namespace burnish::inline core {

/// To be called first in main(). OpenBLAS chooses its kernels by the model of the processor when it is loaded
/// and takes the slowest ones for a model that is newer than itself, four times slower than need be. Then it is made to choose
/// again, by what the processor's instruction sets allow, unless OPENBLAS_CORETYPE is set. Nothing may be computed meanwhile.
void useFastestBlasKernels();

/// Holds OpenBLAS to one thread for good, and ends those that it has started when it was loaded: each looks for work for up to 0.1 s of
/// processor time before it sleeps.
void stopBlasThreads();

/// The library and the kernels that runs compute with: "OpenBLAS 0.3.21, kernels SkylakeX".
std::string blasName();

/// Holds BLAS, and OpenMP in the libraries that the calling thread uses, to one thread: sums would otherwise
/// depend on the number of threads, and starting threads costs more than the small matrices here give back.
void pinLibrariesToOneThread();

/// How many of these threads can compute at a time where the memory is limited: all of them without a limit.
/// Has OpenBLAS take the room that it needs for each of them, for which it would wait for ever later. Throws
/// `Error` if there is none for a single one.
int threadsWithMemory(int wanted);

/// C = A Bᵀ by BLAS, which is faster than the compiler's code from about 30 x 10 on. C is resized.
void multiplyTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C);

/// The same for views; C has the right size already.
void multiplyTransposedInto(const Eigen::Ref<const Eigen::MatrixXd>& A,
                            const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C);

}  // namespace burnish::inline core
