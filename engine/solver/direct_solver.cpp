#include "engine/solver/direct_solver.h"

#include <Eigen/UmfPackSupport>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <unsupported/Eigen/IterativeSolvers>
#include <utility>
#include <vector>

#include "engine/core/blas.h"
#include "engine/solver/cholesky.h"

namespace burnish::inline solver {

using Matrix = Eigen::SparseMatrix<double>;

/// UMFPACK for the whole matrix.
class DirectSolver::General {
 public:
  General() {
    // The pattern is symmetric and nearly all diagonal pivots are good; those of active multipliers, zero at
    // first, fill in during the elimination.
    lu_.umfpackControl()(UMFPACK_STRATEGY) = UMFPACK_STRATEGY_SYMMETRIC;
    lu_.umfpackControl()(UMFPACK_ORDERING) = UMFPACK_ORDERING_AMD;
  }

  bool factorise(const Matrix& A) {
    analyse(A);
    lu_.factorize(A);
    lu_.requireMemory();
    return lu_.info() == Eigen::Success;
  }

  /// Operations of a factorisation, by the pattern; none if they were not counted.
  std::optional<double> cost(const Matrix& A) {
    analyse(A);
    const double flops = lu_.symmetricFlops();
    return flops > 0.0 ? std::optional(flops) : std::nullopt;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) { return lu_.solve(b); }

  Eigen::Index factorNonZeros() { return lu_.matrixL().nonZeros() + lu_.matrixU().nonZeros(); }

 private:
  /// By the pattern alone: the values of the first matrix, which differs in a run that is resumed, must not
  /// decide how those of all others are rounded.
  void analyse(const Matrix& A) {
    if (analysed_) return;
    Matrix pattern = A;
    pattern.coeffs().setOnes();
    lu_.analyzePattern(pattern);
    lu_.requireMemory();
    analysed_ = true;
  }

  /// With what the library tells of its work.
  struct Lu : Eigen::UmfPackLU<Matrix> {
    void requireMemory() const {
      if (m_umfpackInfo(UMFPACK_STATUS) == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
    }
    double symmetricFlops() const { return m_umfpackInfo(UMFPACK_SYMMETRIC_FLOPS); }
  };
  Lu lu_;
  bool analysed_ = false;
};

/// CHOLMOD for the leading block, a dense Schur complement for the border.
class DirectSolver::Definite {
 public:
  explicit Definite(Eigen::Index leading) : n_(leading) {}

  /// False if K or -S is not positive definite, or if the border alone, beside K, costs more than factors of all
  /// of A do: what is known, or about twice as much as those of K.
  bool factorise(const Matrix& A, std::optional<double> costOfWhole = {}) {
    if (K_.rows() == 0) analyse(A);
    if (!llt_->isAnalysed()) return false;
    for (std::size_t k = 0; k < entries_.size(); ++k) K_.valuePtr()[k] = A.valuePtr()[entries_[k]];
    if (!findBorder(A) || costOfBorder() > costOfWhole.value_or(2.0 * llt_->operations())) return false;
    if (!llt_->factorise(K_)) return false;
    return coupled_.empty() || eliminateBorder(A);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    Eigen::VectorXd x(b.size());
    Eigen::VectorXd halfway = llt_->forward(b.head(n_));
    const auto rest = b.size() - n_;
    x.tail(rest) = b.tail(rest).cwiseQuotient(C_);
    if (!coupled_.empty()) {
      const Eigen::VectorXd fromK = B_.transpose() * halfway;
      Eigen::VectorXd residual = -b(coupled_);
      residual.head(numTouching_) += fromK;
      const Eigen::VectorXd border = schur_.solve(residual);
      halfway -= B_ * border.head(numTouching_);
      x(coupled_) = border;
    }
    x.head(n_) = llt_->backward(halfway);
    return x;
  }

  Eigen::Index factorNonZeros() {
    const auto m = static_cast<Eigen::Index>(coupled_.size());
    return static_cast<Eigen::Index>(llt_->nonZeros()) + numTouching_ * n_ + m * (m + 1) / 2;
  }

 private:
  /// The upper triangle of K and where its entries stand in A, whose rows ascend in every column. CHOLMOD
  /// permutes a lower one in two passes.
  void analyse(const Matrix& A) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int column = 0; column < n_; ++column)
      for (int k = A.outerIndexPtr()[column]; k < A.outerIndexPtr()[column + 1]; ++k) {
        const int row = A.innerIndexPtr()[k];
        if (row > column) break;
        triplets.emplace_back(row, column, 0.0);
        entries_.push_back(k);
      }
    K_.resize(n_, n_);
    K_.setFromTriplets(triplets.begin(), triplets.end());
    llt_ = std::make_unique<Cholesky>(K_);
  }

  /// Sorts the border into unknowns that are coupled with K at present, then those that are coupled with
  /// other unknowns of the border alone, and those that stand alone; false if one of these has no equation.
  bool findBorder(const Matrix& A) {
    C_ = A.diagonal().tail(A.cols() - n_);
    coupled_.clear();
    std::vector<int> amongThemselves;
    for (Eigen::Index column = n_; column < A.cols(); ++column) {
      bool touchesK = false, touchesBorder = false;
      for (Matrix::InnerIterator entry(A, column); entry; ++entry) {
        if (entry.value() == 0.0 || entry.row() == column) continue;
        (entry.row() < n_ ? touchesK : touchesBorder) = true;
      }
      if (touchesK)
        coupled_.push_back(static_cast<int>(column));
      else if (touchesBorder)
        amongThemselves.push_back(static_cast<int>(column));
      else if (C_(column - n_) == 0.0)
        return false;
    }
    numTouching_ = std::ssize(coupled_);
    coupled_.insert(coupled_.end(), amongThemselves.begin(), amongThemselves.end());
    return true;
  }

  /// Half of a solution for each column of B costs 2 operations per non-zero, and the Schur complement of what is
  /// coupled with the border alone a dense factorisation.
  double costOfBorder() const {
    const auto m = static_cast<double>(coupled_.size()), touching = static_cast<double>(numTouching_);
    const double dense = (m * m * m - touching * touching * touching) / 3.0;
    return 2.0 * llt_->nonZeros() * touching + dense;
  }

  bool eliminateBorder(const Matrix& A) {
    const auto m = static_cast<Eigen::Index>(coupled_.size());
    B_.setZero(n_, numTouching_);
    Eigen::MatrixXd S(m, m);
    S.setZero();
    for (Eigen::Index j = 0; j < numTouching_; ++j)
      for (Matrix::InnerIterator entry(A, coupled_[static_cast<std::size_t>(j)]); entry; ++entry)
        if (entry.row() < n_) B_(entry.row(), j) = entry.value();
    B_ = llt_->forward(B_);
    S.topLeftCorner(numTouching_, numTouching_).noalias() = B_.transpose() * B_;
    placeInBorder_.assign(static_cast<std::size_t>(A.cols() - n_), -1);
    for (std::size_t j = 0; j < coupled_.size(); ++j)
      placeInBorder_[static_cast<std::size_t>(coupled_[j] - n_)] = static_cast<int>(j);
    for (Eigen::Index j = 0; j < m; ++j)
      for (Matrix::InnerIterator entry(A, coupled_[static_cast<std::size_t>(j)]); entry; ++entry) {
        if (entry.row() < n_) continue;
        const int i = placeInBorder_[static_cast<std::size_t>(entry.row() - n_)];
        if (i >= 0) S(i, j) -= entry.value();
      }
    schur_.compute(S);
    return schur_.info() == Eigen::Success;
  }

  Eigen::Index n_;
  std::unique_ptr<Cholesky> llt_;  ///< of K; null before the first matrix
  Matrix K_;
  std::vector<int> entries_;
  Eigen::VectorXd C_;
  std::vector<int> coupled_;        ///< columns of the border in the Schur complement, those of B first
  Eigen::Index numTouching_ = 0;    ///< columns of B
  std::vector<int> placeInBorder_;  ///< per unknown of the border: its place in `coupled_`, -1 if it has none
  Eigen::MatrixXd B_;               ///< L⁻¹ P times the columns of the border
  Eigen::LLT<Eigen::MatrixXd> schur_;  ///< of -S = Bᵀ K⁻¹ B - C
};

namespace {

/// What GMRES of Eigen takes as a preconditioner: any solution for a right-hand side.
class SolvedBy {
 public:
  using Scalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  void use(std::function<Eigen::VectorXd(const Eigen::VectorXd&)> solve) { solve_ = std::move(solve); }

  template <class M>
  SolvedBy& analyzePattern(const M&) {
    return *this;
  }
  template <class M>
  SolvedBy& factorize(const M&) {
    return *this;
  }
  template <class M>
  SolvedBy& compute(const M&) {
    return *this;
  }
  template <class Vector>
  Eigen::VectorXd solve(const Vector& b) const {
    return solve_(b);
  }
  Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> solve_;
};

}  // namespace

/// A symmetric matrix near to a general one, for GMRES. Of K it has the symmetric part; of two entries of the
/// border that face each other the smaller one, none if their signs differ: in slip the tangential multiplier
/// depends on the pressure, which does not depend on it, and the mean of both would couple them as if it did.
class DirectSolver::Companion {
 public:
  explicit Companion(Eigen::Index leading) : leading_(leading), symmetric_(leading) {}

  bool factorise(const Matrix& A, std::optional<double> costOfWhole) {
    if (opposite_.empty()) {
      findOpposite(A);
      near_ = A;
    }
    A_ = A;
    const double* values = A.valuePtr();
    for (int column = 0; column < A.cols(); ++column)
      for (int k = A.outerIndexPtr()[column]; k < A.outerIndexPtr()[column + 1]; ++k) {
        const double here = values[k], there = values[opposite_[static_cast<std::size_t>(k)]];
        const bool isInBorder = column >= leading_ || A.innerIndexPtr()[k] >= leading_;
        near_.valuePtr()[k] = !isInBorder                        ? 0.5 * (here + there)
                              : here * there <= 0.0              ? 0.0
                              : std::abs(here) < std::abs(there) ? here
                                                                 : there;
      }
    return symmetric_.factorise(near_, costOfWhole);
  }

  /// None if GMRES does not get near enough.
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) const {
    constexpr int kMostIterations = 60;
    constexpr double kTolerance = 1e-12;
    Eigen::GMRES<Matrix, SolvedBy> gmres;
    gmres.preconditioner().use([this](const Eigen::VectorXd& v) { return symmetric_.solve(v); });
    gmres.set_restart(kMostIterations);
    gmres.setMaxIterations(kMostIterations);
    gmres.setTolerance(kTolerance);
    gmres.compute(A_);
    Eigen::VectorXd x = gmres.solve(b);
    if (gmres.info() != Eigen::Success || !x.allFinite()) return std::nullopt;
    return x;
  }

  const Matrix& matrix() const { return A_; }
  Eigen::Index factorNonZeros() { return symmetric_.factorNonZeros(); }

 private:
  /// Where the entry (j, i) stands for each entry (i, j); rows ascend in every column.
  void findOpposite(const Matrix& A) {
    std::vector<int> next(A.outerIndexPtr(), A.outerIndexPtr() + A.cols());
    opposite_.resize(static_cast<std::size_t>(A.nonZeros()));
    for (int column = 0; column < A.cols(); ++column)
      for (int k = A.outerIndexPtr()[column]; k < A.outerIndexPtr()[column + 1]; ++k)
        opposite_[static_cast<std::size_t>(k)] = next[static_cast<std::size_t>(A.innerIndexPtr()[k])]++;
  }

  Eigen::Index leading_;
  Definite symmetric_;
  std::vector<int> opposite_;  ///< per entry
  Matrix A_, near_;
};

DirectSolver::DirectSolver(Eigen::Index leading, TangentKind kind)
    : definite_(kind == TangentKind::Symmetric ? std::make_unique<Definite>(leading) : nullptr),
      companion_(kind == TangentKind::General ? std::make_unique<Companion>(leading) : nullptr),
      general_(std::make_unique<General>()) {
  pinLibrariesToOneThread();
}

DirectSolver::~DirectSolver() = default;

bool DirectSolver::factorise(const Matrix& A) {
  if (!A.coeffs().allFinite()) return false;
  isDefinite_ = definite_ && definite_->factorise(A);
  hasCompanion_ = companion_ && companion_->factorise(A, general_->cost(A));
  hasFactors_ = isDefinite_ || hasCompanion_ || factoriseWhole(A);
  return hasFactors_;
}

bool DirectSolver::factoriseWhole(const Matrix& A) {
  ++numGeneral_;
  return general_->factorise(A);
}

Eigen::VectorXd DirectSolver::solve(const Eigen::VectorXd& b) {
  if (isDefinite_) return definite_->solve(b);
  if (hasCompanion_) {
    if (auto x = companion_->solve(b)) return *std::move(x);
    hasCompanion_ = false;
    if (!factoriseWhole(companion_->matrix()))
      return Eigen::VectorXd::Constant(b.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return general_->solve(b);
}

Eigen::Index DirectSolver::factorNonZeros() {
  if (!hasFactors_) return 0;
  return isDefinite_     ? definite_->factorNonZeros()
         : hasCompanion_ ? companion_->factorNonZeros()
                         : general_->factorNonZeros();
}

}  // namespace burnish::inline solver
