#pragma once
#include <Eigen/Dense>

namespace burnish {

/// Holds BLAS to one thread: its sums would otherwise depend on the number of threads.
void pinBlasToOneThread();

/// C = A Bᵀ by BLAS, which is faster than the compiler's code from about 30 x 10 on. C is resized.
void multiplyTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C);

}  // namespace burnish
