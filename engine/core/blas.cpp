#include "engine/core/blas.h"

#include <cblas.h>

#include <cassert>

namespace burnish {

void pinBlasToOneThread() {
  openblas_set_num_threads(1);
}

void multiplyTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Eigen::MatrixXd& C) {
  assert(A.cols() == B.cols());
  C.resize(A.rows(), B.rows());
  const auto size = [](Eigen::Index n) { return static_cast<blasint>(n); };
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, size(A.rows()), size(B.rows()), size(A.cols()), 1.0,
              A.data(), size(A.rows()), B.data(), size(B.rows()), 0.0, C.data(), size(C.rows()));
}

}  // namespace burnish
