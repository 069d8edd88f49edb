#include "engine/solver/linear_solver.h"

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

namespace burnish {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

class Umfpack final : public LinearSolver {
 public:
  Umfpack() {
    // The pattern is symmetric and nearly all diagonal pivots are good; those of active multipliers, zero at
    // first, fill in during the elimination.
    lu_.umfpackControl()(UMFPACK_STRATEGY) = UMFPACK_STRATEGY_SYMMETRIC;
    lu_.umfpackControl()(UMFPACK_ORDERING) = UMFPACK_ORDERING_AMD;
  }

  bool factorise(const Matrix& A) override {
    if (!A.coeffs().allFinite()) return false;
    if (!analysed_) lu_.analyzePattern(A);
    analysed_ = true;
    lu_.factorize(A);
    return lu_.info() == Eigen::Success;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override { return lu_.solve(b); }

  Eigen::Index factorNonZeros() override { return lu_.matrixL().nonZeros() + lu_.matrixU().nonZeros(); }

 private:
  Eigen::UmfPackLU<Matrix> lu_;
  bool analysed_ = false;
};

class Cholmod final : public LinearSolver {
 public:
  Cholmod() { llt_.cholmod().print = 0; }  // a matrix that is not positive definite is no surprise here

  bool factorise(const Matrix& A) override {
    if (!A.coeffs().allFinite()) return false;
    if (!analysed_) llt_.analyzePattern(A);
    analysed_ = true;
    llt_.factorize(A);
    definite_ = llt_.info() == Eigen::Success;
    return definite_ || lu_.factorise(A);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) override {
    if (definite_) return llt_.solve(b);
    return lu_.solve(b);
  }

  Eigen::Index factorNonZeros() override {
    return definite_ ? static_cast<Eigen::Index>(llt_.cholmod().lnz) : lu_.factorNonZeros();
  }

 private:
  Eigen::CholmodSupernodalLLT<Matrix> llt_;
  Umfpack lu_;
  bool analysed_ = false;
  bool definite_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> makeLinearSolver(MatrixKind kind) {
  if (kind == MatrixKind::SaddlePoint) return std::make_unique<Umfpack>();
  return std::make_unique<Cholmod>();
}

}  // namespace burnish
